// ITK's description of the compiler, for clang, which the sanitizers' presets use. Debian's package knows only the one that it
// was built with, GCC 12, and refuses others. clang is close enough to pass for that.
#pragma once

#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#undef __clang__
#undef __GNUC__
#define __GNUC__ 12
#include <itk_compiler_detection.h>
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__clang__")
