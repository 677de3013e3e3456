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
    std::map<std::string, CLI::Option*> declared;  // several devices may share one
    for (const DeviceEntry& entry : devices())
        for (const DeviceOption& option : entry.options) {
            const std::string text = fmt::format("With --device {}: {}", entry.name, option.help);
            CLI::Option*& of_flag = declared[option.flag];
            if (of_flag == nullptr)
                of_flag = app.add_option(option.flag, texts_[option.flag], text)->type_name(option.type_name);
            else
                of_flag->description(of_flag->get_description() + "\n" + text);
        }
    app.add_flag("--list-devices", lists_devices_,
                 "Say which haptic devices are plugged in and whether they can be used, and end");
}

DeviceChoice DeviceOptions::checked() const {
    DeviceChoice choice;
    choice.lists_devices = lists_devices_;
    choice.entry = &find_device(device_);
    std::map<std::string, std::string> typed;
    for (const DeviceOption& option : choice.entry->options) {
        const std::string& text = texts_.at(option.flag);
        if (text.empty()) continue;
        if (option.names_file)
            choice.files_read.push_back({.option = option.flag,
                                         .path = text,
                                         .is_written = false,
                                         .is_replaced_by = option.is_replaced_by});
        typed[option.flag] = text;
    }
    for (const DeviceEntry& entry : devices())
        for (const DeviceOption& option : entry.options)
            // Not for this device.
            if (!texts_.at(option.flag).empty() && !typed.contains(option.flag))
                throw std::invalid_argument(
                    fmt::format("{}: goes with --device {}", option.flag, entry.name));
    choice.prepare = choice.entry->checked(TypedOptions(std::move(typed)));
    return choice;
}

}  // namespace osteomill
