# How tests are declared: unit tests and those of the programs in GoogleTest, tests in Python, hostile input, encoders under valgrind, timings.

# osteomill_run(TEST PROGRAM FILTER PROPERTIES...): the program's tests that the filter takes. A unit test is over in milliseconds, sooner
# than its process begins: one process runs all of a program's. The real programs wait more than they compute: ctest runs theirs one by
# one, several at a time.
function(osteomill_run test program filter)
    if(NOT osteomill_one_process_a_program)
        gtest_discover_tests(${program} TEST_FILTER "${filter}" DISCOVERY_TIMEOUT 300 PROPERTIES TIMEOUT 300 ${ARGN})
        return()
    endif()
    set(filter_of_program)
    if(filter)
        set(filter_of_program "--gtest_filter=${filter}")
    endif()
    add_test(NAME ${test} COMMAND ${program} --gtest_brief=1 ${filter_of_program})
    set_tests_properties(${test} PROPERTIES TIMEOUT 900 ${ARGN})
endfunction()

# osteomill_test(NAME [SOURCES file...] [FOLDERS folder... [EXCEPT file...]] LIBRARIES ... [PROGRAMS program...] [DEFINES name=text...] [DRAWS]
#                [BUSY] [LABEL name] [TIMEOUT seconds] [CLAIMS filter] [NIGHTLY filter] [ADDRESS filter] [THREADS filter]
#                [SANITIZED_NIGHTLY] [THREADS_NIGHTLY]):
# a GoogleTest program whose tests ctest lists one by one. Filters are GoogleTest's.
# FOLDERS: every *_test.cpp in them is a source, EXCEPT these. With neither these nor SOURCES: NAME.cpp.
# PROGRAMS: it runs these, by support/child_process.h: HAPTIC_SERVER is the path of haptic_server; it talks to them, and reads what they write.
# DRAWS: it uses OpenGL; drivers are unloaded before the leak checker looks and leave leaks that no suppression can name.
# BUSY: it keeps two cores busy, and a haptic loop that gets none stops for safety.
# CLAIMS: its tests of a flagship claim: `ctest -L claims`.
# NIGHTLY: its tests that only `./test.sh all` runs: long sweeps of properties that shorter tests check, and whole studies.
# ADDRESS: its tests under AddressSanitizer; by default all; NONE.
# THREADS: its tests under ThreadSanitizer; by default none, and then the program is not built.
# SANITIZED_NIGHTLY: these two hold for `./test.sh all` alone, since unit tests run the same code under the same sanitizer.
# THREADS_NIGHTLY: THREADS holds for `./test.sh all` alone: two fifths of that build are what only these tests need.
function(osteomill_test name)
    cmake_parse_arguments(arg "DRAWS;BUSY;SANITIZED_NIGHTLY;THREADS_NIGHTLY" "LABEL;TIMEOUT;CLAIMS;NIGHTLY;ADDRESS;THREADS"
        "SOURCES;FOLDERS;EXCEPT;LIBRARIES;PROGRAMS;DEFINES" ${ARGN})
    osteomill_sources(found *_test.cpp ${arg_FOLDERS} EXCEPT ${arg_EXCEPT})
    if(NOT arg_SOURCES AND NOT arg_FOLDERS)
        set(found ${name}.cpp)
    endif()
    if(arg_PROGRAMS)
        list(APPEND found ${CMAKE_SOURCE_DIR}/tests/support/child_process.cpp)
        list(APPEND arg_LIBRARIES osteomill_wire nlohmann_json::nlohmann_json)
    endif()
    add_executable(${name} ${arg_SOURCES} ${found})
    target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} GTest::gmock GTest::gtest_main osteomill_warnings)
    set_target_properties(${name} PROPERTIES DISABLE_PRECOMPILE_HEADERS OFF)
    target_precompile_headers(${name} REUSE_FROM osteomill_test_precompiled)
    target_compile_options(${name} PRIVATE ${osteomill_test_options})
    target_compile_definitions(${name} PRIVATE ${arg_DEFINES})
    foreach(program ${arg_PROGRAMS})
        string(TOUPPER ${program} variable)
        target_compile_definitions(${name} PRIVATE ${variable}="$<TARGET_FILE:${program}>")
        add_dependencies(${name} ${program})
    endforeach()
    set(instrumented)
    if(OSTEOMILL_SANITIZER STREQUAL "address")
        set(instrumented "${arg_ADDRESS}")
    elseif(OSTEOMILL_SANITIZER STREQUAL "thread")
        set(instrumented "${arg_THREADS}")
        if(NOT arg_THREADS OR (arg_THREADS_NIGHTLY AND NOT OSTEOMILL_NIGHTLY))
            set(instrumented NONE)
        endif()
    endif()
    if(arg_SANITIZED_NIGHTLY AND NOT OSTEOMILL_SANITIZER STREQUAL "none" AND NOT OSTEOMILL_NIGHTLY)
        set(instrumented NONE)
    endif()
    if(instrumented STREQUAL "NONE")
        set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
        return()
    endif()

    set(properties)
    if(arg_DRAWS)
        set(properties ENVIRONMENT ASAN_OPTIONS=detect_leaks=0)
    endif()
    if(arg_BUSY)
        list(APPEND properties PROCESSORS 2)
    endif()
    if(arg_LABEL)
        list(APPEND properties LABELS ${arg_LABEL})
    endif()
    if(arg_TIMEOUT)
        list(APPEND properties TIMEOUT ${arg_TIMEOUT})
    endif()
    set(rest "${instrumented}")
    if(NOT instrumented)
        if(arg_CLAIMS)
            osteomill_run(${name}_claims ${name} "${arg_CLAIMS}" ${properties} LABELS claims)
        endif()
        if(arg_NIGHTLY)
            osteomill_run(${name}_nightly ${name} "${arg_NIGHTLY}" ${properties} LABELS nightly)
        endif()
        if(arg_CLAIMS OR arg_NIGHTLY)
            string(JOIN ":" rest ${arg_CLAIMS} ${arg_NIGHTLY})
            string(PREPEND rest "-")
        endif()
    endif()
    osteomill_run(${name} ${name} "${rest}" ${properties})
endfunction()

# osteomill_python_test(NAME [PROPERTY VALUE]...): the tests of NAME_test.py.
function(osteomill_python_test name)
    add_test(NAME python_${name} COMMAND ${Python_EXECUTABLE} -m unittest ${name}_test ${osteomill_unittest_options}
             WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    string(JOIN ";" environment
        "PYTHONPATH=${CMAKE_BINARY_DIR}/python" PYTHONDONTWRITEBYTECODE=1 "OSTEOMILL_PROGRAMS=${CMAKE_RUNTIME_OUTPUT_DIRECTORY}"
        "OSTEOMILL_BUILD=${CMAKE_BINARY_DIR}" "OSTEOMILL_BUILD_TYPE=${CMAKE_BUILD_TYPE}" "OSTEOMILL_SANITIZER=${OSTEOMILL_SANITIZER}")
    set_tests_properties(python_${name} PROPERTIES TIMEOUT 900 ENVIRONMENT "${environment}" ${ARGN})
endfunction()

# osteomill_program_test(NAME PROGRAMS program... [ADDRESS pattern...] [ADDRESS_NIGHTLY pattern...] [THREADS_NIGHTLY pattern...]): the tests of
# NAME_test.py, which run these programs and import nothing of ours.
# ADDRESS, THREADS: those that run under AddressSanitizer and ThreadSanitizer; NIGHTLY: only for `./test.sh all`. Patterns are unittest's.
function(osteomill_program_test name)
    cmake_parse_arguments(arg "" "" "PROGRAMS;ADDRESS;ADDRESS_NIGHTLY;THREADS_NIGHTLY" ${ARGN})
    set(patterns)
    if(OSTEOMILL_SANITIZER STREQUAL "address")
        set(patterns ${arg_ADDRESS})
    endif()
    if(OSTEOMILL_SANITIZER STREQUAL "address" AND OSTEOMILL_NIGHTLY)
        list(APPEND patterns ${arg_ADDRESS_NIGHTLY})
    elseif(OSTEOMILL_SANITIZER STREQUAL "thread" AND OSTEOMILL_NIGHTLY)
        list(APPEND patterns ${arg_THREADS_NIGHTLY})
    endif()
    set(osteomill_program_tests ${osteomill_program_tests} ${name}_test.py PARENT_SCOPE)
    if(NOT patterns AND NOT OSTEOMILL_SANITIZER STREQUAL "none")
        return()
    endif()
    list(TRANSFORM patterns PREPEND -k OUTPUT_VARIABLE osteomill_unittest_options)
    osteomill_python_test(${name})
    # An instrumented build makes only the programs that its tests need.
    add_custom_target(programs_of_python_${name} ALL)
    add_dependencies(programs_of_python_${name} ${arg_PROGRAMS})
endfunction()

# osteomill_fuzz(NAME LIBRARY [TARGETS target...]): NAME.cpp, which hands bytes to the library; by libFuzzer as the programs fuzz_TARGET,
# by default fuzz_NAME, with the mutator NAME_mutator.cpp if there is one.
function(osteomill_fuzz name library)
    cmake_parse_arguments(arg "" "" "TARGETS" ${ARGN})
    osteomill_module(osteomill_fuzz_${name} SOURCES ${name}.cpp LIBRARIES ${library})
    target_link_libraries(osteomill_fuzz_all INTERFACE osteomill_fuzz_${name})
    osteomill_fuzzed(${library})
    # libFuzzer is clang's, and needs its instrumentation.
    if(NOT (OSTEOMILL_SANITIZER STREQUAL "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang"))
        return()
    endif()
    if(NOT arg_TARGETS)
        set(arg_TARGETS ${name})
    endif()
    file(GLOB mutator CONFIGURE_DEPENDS ${name}_mutator.cpp)
    foreach(target ${arg_TARGETS})
        configure_file(entry.cpp.in ${target}_entry.cpp @ONLY)
        add_executable(fuzz_${target} ${CMAKE_CURRENT_BINARY_DIR}/${target}_entry.cpp ${mutator})
        target_link_libraries(fuzz_${target} PRIVATE osteomill_fuzz_${name} osteomill_mutate_parts osteomill_warnings)
        target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
    endforeach()
endfunction()

# osteomill_memcheck(TEST [NIGHTLY] PROGRAM FILTER): those tests of a GoogleTest program; or PROGRAM COMMAND ARGUMENTS...
# NIGHTLY: it takes minutes, or waits for another thread, which a busy machine lets wait too long under valgrind. There a wait takes thirty times as long; --fair-sched lets each go on.
function(osteomill_memcheck test)
    cmake_parse_arguments(arg "NIGHTLY" "" "COMMAND" ${ARGN})
    list(POP_FRONT arg_UNPARSED_ARGUMENTS program filter)
    if(filter)
        set(arg_COMMAND --gtest_brief=1 --gtest_filter=${filter})
    endif()
    if(osteomill_valgrind)
        add_test(NAME EncodersUnderValgrind.${test} COMMAND ${osteomill_valgrind} --quiet --error-exitcode=9 --leak-check=no --fair-sched=yes
                 $<TARGET_FILE:${program}> ${arg_COMMAND})
        set_tests_properties(EncodersUnderValgrind.${test} PROPERTIES TIMEOUT 900)
    else()
        add_test(NAME EncodersUnderValgrind.${test} COMMAND ${CMAKE_COMMAND} -E echo "skipped: valgrind is not installed (Debian: valgrind)")
        set_tests_properties(EncodersUnderValgrind.${test} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped")
    endif()
    if(arg_NIGHTLY)
        set_tests_properties(EncodersUnderValgrind.${test} PROPERTIES LABELS nightly)
    endif()
endfunction()

# osteomill_benchmark(NAME LIBRARIES...): NAME.cpp, which the target `benchmarks` builds.
function(osteomill_benchmark name)
    add_executable(${name} ${name}.cpp)
    target_link_libraries(${name} PRIVATE ${ARGN} osteomill_warnings)
    add_dependencies(benchmarks ${name})
endfunction()
