// The key that a person means: a letter or sign means the key that bears it, wherever the layout has it.
#pragma once

#include <string_view>

namespace osteomill {

/// `key`: GLFW's number, the place on a US keyboard; `printed`: the sign that the layout in use writes there
/// without shift (glfwGetKeyName), empty if there is none. Returns GLFW's number of the key that is meant:
/// the row of digits stays that, because its keys bear digits on every layout; a letter of another alphabet
/// stands for the Latin one at its place; a sign that has no meaning here is no key (-1).
int meant_key(int key, std::string_view printed);

}  // namespace osteomill
