"""The evaluation: everything that measures, compares, fits and draws. ``python3 -m osteomill.studies --help``

A study is a module here and a row of ``program.STUDIES``. It has

    add_options(parser)     its options, beside --out, --jobs, --shard and --merge, which every study has;
    run(options, study) its work: ``options`` as parsed, ``study`` a study_run.StudyRun;

and, if they differ from the usual,

    JOBS                    how many cases run at a time unless --jobs says so: 1 where it measures times;
    ONE_BY_ONE              true: whatever --jobs says;
    WRITES                  names (fnmatch) of what it writes into --out, none of which may be a file that it reads;
    IS_REPEATED             false: it writes elsewhere than into --out, too, and so is not run by `repeat`.

It raises ValueError, RuntimeError or OSError in one line for an error in its input, and options.UsageError for an
error on the command line.
"""
