// The key that a person means: a letter or sign is what is printed on it, wherever the layout has it.
#pragma once

#include <string_view>

namespace osteomill {

/// `key`: of GLFW, the place on a US keyboard; `printed`: what the layout in use writes there without shift
/// (glfwGetKeyName), empty where it says nothing. Returns GLFW's number of the key that is meant: the digits'
/// row stays the digits', whose keys bear them on every layout; a letter of another alphabet stands for the
/// Latin one at its place; a sign that has no meaning here is no key (-1).
int meant_key(int key, std::string_view printed);

}  // namespace osteomill
