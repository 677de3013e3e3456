#include "haptic_server/program/device_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <utility>

#include "common/program/option_checks.h"

namespace osteomill {

void DeviceOptions::declare(CLI::App& app) {
    std::vector<std::string> names;
    std::string help = "Who moves the tool:";
    for (const DeviceEntry& entry : devices()) {
        names.emplace_back(entry.name);
        help += fmt::format("\n  {}: {}", entry.name, entry.text);
    }
    app.add_option("--device", device_, help)->check(one_of(names))->capture_default_str();
    for (const DeviceEntry& entry : devices())
        for (const DeviceOption& option : entry.options)
            app.add_option(option.flag, texts_[option.flag],
                           fmt::format("With --device {}: {}", entry.name, option.help))
                ->type_name(option.type_name);
    app.add_flag("--list-devices", lists_devices_,
                 "Say which haptic devices are plugged in and whether they can be used, and end");
}

DeviceChoice DeviceOptions::checked() const {
    DeviceChoice choice;
    choice.lists_devices = lists_devices_;
    choice.entry = &find_device(device_);
    std::map<std::string, std::string> typed;
    for (const DeviceEntry& entry : devices())
        for (const DeviceOption& option : entry.options) {
            const std::string& text = texts_.at(option.flag);
            if (text.empty()) continue;
            if (&entry != choice.entry)
                throw std::invalid_argument(
                    fmt::format("{}: goes with --device {}", option.flag, entry.name));
            if (option.names_file) choice.files_read.push_back({option.flag, text, false});
            typed[option.flag] = text;
        }
    choice.prepare = choice.entry->checked(TypedOptions(std::move(typed)));
    return choice;
}

}  // namespace osteomill
