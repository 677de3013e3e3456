# OSTEOMILL_JOINED_SOURCES: whether the sources of a target are compiled joined, several in one go, so that headers that are long
# to parse are parsed once: what CMake calls a unity build. It is there for runs that compile everything once, and halves their
# time. A change then compiles several files again, so presets that one works with leave it off; so does `release` but for what
# lies in tests/, which shows that every other file includes what it uses.
set(OSTEOMILL_JOINED_SOURCES none CACHE STRING "Of which targets to compile sources joined: none, tests, all")
set_property(CACHE OSTEOMILL_JOINED_SOURCES PROPERTY STRINGS none tests all)
if(NOT OSTEOMILL_JOINED_SOURCES MATCHES "^(none|tests|all)$")
    message(FATAL_ERROR "OSTEOMILL_JOINED_SOURCES is '${OSTEOMILL_JOINED_SOURCES}'; choose none, tests or all")
endif()

# osteomill_join(NAME IS_SEPARATE): for a target of this folder. IS_SEPARATE: its files give one name to several things, each in a
# namespace without a name, and cannot be joined.
function(osteomill_join name is_separate)
    cmake_path(SET tests_folder "${PROJECT_SOURCE_DIR}/tests")
    cmake_path(IS_PREFIX tests_folder "${CMAKE_CURRENT_SOURCE_DIR}" is_in_tests)
    if(OSTEOMILL_JOINED_SOURCES STREQUAL "all" OR (OSTEOMILL_JOINED_SOURCES STREQUAL "tests" AND is_in_tests))
        if(NOT is_separate)
            set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
        endif()
    endif()
endfunction()
