#include "common/scene/scene_file.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

void scene(Bytes input) {
    Scene scene;
    try {
        scene = parse_scene({reinterpret_cast<const char*>(input.data()), input.size()}, "fuzz.toml");
    } catch (const SceneError& error) {
        const std::string line = error.what();
        require(line.find("fuzz.toml") == 0, "a complaint without its file: " + line);
        require(line.find('\n') == std::string::npos, "a complaint of several lines: " + line);
        return;
    }
    require(!scene.burrs.empty() && scene.start_burr < scene.burrs.size(), "a burr that is not there");
    const std::string written = write_scene(scene);
    try {
        require(parse_scene(written, "again.toml") == scene, "a scene that changes when it is written");
    } catch (const SceneError& error) {
        throw BrokenInvariant(std::string("a scene that cannot be read when it is written: ") + error.what());
    }
}

}  // namespace osteomill::fuzz
