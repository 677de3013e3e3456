# What nearly every file includes is parsed once a preset instead of once a file, which is half of the time that a compiler needs
# for a test. Only for speed: every file still includes what it uses, which the debug preset proves by doing without but in tests.
# So does the release preset, which must: optimising, GCC 12 takes what is inlined from a precompiled std::string for out of bounds.
set(osteomill_common_headers
    <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <optional> <span>
    <stdexcept> <string> <string_view> <utility> <variant> <vector>
    <glm/common.hpp> <glm/geometric.hpp> <glm/mat3x3.hpp> <glm/matrix.hpp> <glm/vec2.hpp> <glm/vec3.hpp>)

# osteomill_precompile(NAME LIBRARIES lib ... HEADERS <h> ...): a target whose precompiled headers others reuse.
function(osteomill_precompile name)
    cmake_parse_arguments(arg "" "" "LIBRARIES;HEADERS" ${ARGN})
    file(CONFIGURE OUTPUT ${name}.cpp CONTENT "// Nothing but the precompiled headers.\n")
    add_library(${name} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} osteomill_warnings)
    target_precompile_headers(${name} PRIVATE ${arg_HEADERS})
endfunction()

osteomill_precompile(osteomill_precompiled LIBRARIES glm::glm HEADERS ${osteomill_common_headers})
# Precompiled headers serve only what is compiled with the same optimisation.
osteomill_precompile(osteomill_loops_precompiled LIBRARIES glm::glm HEADERS ${osteomill_common_headers})
target_compile_options(osteomill_loops_precompiled PRIVATE ${osteomill_loops_options})
