"""The evaluation: everything that measures, compares, fits and draws. ``python3 -m osteomill.studies --help``

A study is a module here and a row of ``program.STUDIES``. It has

    add_options(parser)     its options, beside --out, --jobs, --shard and --merge, which every study has;
    run(options, study)     what it does: ``options`` as parsed, ``study`` a study_run.StudyRun;

and, where they are other than usual,

    JOBS                    how many cases run at a time unless --jobs says so: 1 where it measures times;
    ONE_BY_ONE              true: whatever --jobs says;
    WRITES                  names (fnmatch) of what it writes into --out, none of which may be a file that it reads;
    IS_REPEATED             false: it writes elsewhere than into --out, too, and so is not run by `repeat`.

It raises ValueError, RuntimeError or OSError in one line for what is wrong in its input, and
options.UsageError for what is wrong on the command line.
"""
