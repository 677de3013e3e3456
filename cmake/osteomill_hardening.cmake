# Flags that make a defect harder to exploit if it gets past the tests, since the programs read untrusted data. Every target has
# them, but those of the sanitizers, which find more and bring checks of their own.
#
# - a canary behind the arrays of a function: a write beyond one ends the program before the function returns
# - _FORTIFY_SOURCE: the C library's copies check the sizes that the compiler knows; needs optimisation
# - a program is loaded anywhere (PIE), and its table of functions is filled once and then sealed (full RELRO)
# - indirect jumps land on marked places only, and returns go where they came from, where processor and system enforce it
if(NOT OSTEOMILL_SANITIZER STREQUAL "none")
    return()
endif()
include(CheckCXXCompilerFlag)

# -fPIC, for the module of Python takes the same libraries as the programs; the loops do not pay for names that none can replace.
add_compile_options(-fstack-protector-strong -fPIC -fno-semantic-interposition
                    $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE>
                    $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-D_FORTIFY_SOURCE=2>)
add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-pie> -Wl,-z,relro,-z,now,-z,noexecstack)
# Only x86 has it.
check_cxx_compiler_flag(-fcf-protection OSTEOMILL_HAS_CF_PROTECTION)
if(OSTEOMILL_HAS_CF_PROTECTION)
    add_compile_options(-fcf-protection)
endif()
