# Warnings for every target of the project; third-party headers are SYSTEM and exempt. They are errors for developers and in continuous
# integration: in the preset `debug`, and where OSTEOMILL_WARNINGS_AS_ERRORS=ON is in the environment. A user's compiler may be newer than
# any that was tried, and its new warnings must not stop his build.
option(OSTEOMILL_WARNINGS_AS_ERRORS "A warning stops the build" OFF)
add_library(osteomill_warnings INTERFACE)
target_compile_options(osteomill_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual $<$<BOOL:${OSTEOMILL_WARNINGS_AS_ERRORS}>:-Werror>)
# A name within a function hides nothing of its own file where what it hides belongs to a file that is joined with it; clang cannot tell
# these from names that a function hides of itself.
target_compile_options(osteomill_warnings INTERFACE
    $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>)
# GCC takes a joined file for a header, whose coroutines must not hold what belongs to one file alone.
target_compile_options(osteomill_warnings INTERFACE
    $<$<AND:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
