# OSTEOMILL_SANITIZER: none, address (with UBSan, and counters for libFuzzer) or thread. The presets asan and tsan set it.
set(OSTEOMILL_SANITIZER none CACHE STRING "Instrument everything: none, address (and undefined behaviour), thread")
set_property(CACHE OSTEOMILL_SANITIZER PROPERTY STRINGS none address thread)

if(OSTEOMILL_SANITIZER STREQUAL "address")
    # UBSan's checks of each pointer for null and alignment are a fifth of the time that the compiler takes, and AddressSanitizer
    # stops at a null pointer in use anyway.
    add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment -fno-sanitize-recover=all
                        -fno-omit-frame-pointer)
    # Clang 14 cannot compile coroutines with the check of function pointers' types.
    add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,Clang>:-fno-sanitize=function>)
    add_link_options(-fsanitize=address,undefined)
elseif(OSTEOMILL_SANITIZER STREQUAL "thread")
    add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
    add_compile_definitions(BOOST_ASIO_DISABLE_FENCED_BLOCK)
    add_link_options(-fsanitize=thread)
elseif(NOT OSTEOMILL_SANITIZER STREQUAL "none")
    message(FATAL_ERROR "OSTEOMILL_SANITIZER is '${OSTEOMILL_SANITIZER}'; choose none, address or thread")
endif()

# osteomill_fuzzed(NAME...): modules in which libFuzzer sees which code an input reaches: a seventh more time to compile. Without the
# compared values, which would cost every test time: the fuzz targets have dictionaries.
function(osteomill_fuzzed)
    if(OSTEOMILL_SANITIZER STREQUAL "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        foreach(name ${ARGN})
            target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fsanitize-coverage=inline-8bit-counters,pc-table>)
        endforeach()
    endif()
endfunction()
