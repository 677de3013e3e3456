# Warnings are errors in every target of the project; third-party headers are SYSTEM and exempt.
add_library(osteomill_warnings INTERFACE)
target_compile_options(osteomill_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
    -Woverloaded-virtual -Werror)
