# How hard the compiler tries: a third of its time goes into optimising (11.5 s, 9.6 s and 7.5 s with -O3, -O2 and -O1 for eight sources of the
# window), and only the modules with inner loops (LOOPS in osteomill_module) repay that. The others have the presets' settings. The results
# are the same to the bit.
set(osteomill_loops_options)
if(OSTEOMILL_SANITIZER MATCHES "^(address|thread)$")
    set(osteomill_loops_options -O1)
elseif(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT CMAKE_CXX_FLAGS_RELEASE MATCHES "-O3")
    set(osteomill_loops_options -O3)
endif()
