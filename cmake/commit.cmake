# The source of a package says of which commit it is (scripts/package.sh); elsewhere git does.
# Writes OUT, the source of commit.h, where the commit has changed since: cmake -DSOURCE=... -DOUT=... -P commit.cmake
if(EXISTS ${SOURCE}/COMMIT)
    file(STRINGS ${SOURCE}/COMMIT commit)
else()
    execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=+ --exclude=* --abbrev=12
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
endif()
if(failed OR NOT commit)
    set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT [[
#include "common/program/commit.h"

std::string_view osteomill::built_from_commit() { return "@commit@"; }
]])
