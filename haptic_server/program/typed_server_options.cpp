#include "haptic_server/program/typed_server_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/program/command_options.h"
#include "common/program/run_program.h"
#include "common/scene/scene.h"
#include "common/session/session_control.h"
#include "common/words/translation.h"
#include "haptic_server/session/measured_device.h"
#include "haptic_server/session/session_defaults.h"

namespace osteomill {

namespace {

/// A line for each.
std::string force_model_help() {
    std::string text = "How bone pushes back:";
    for (const ForceModelEntry& model : force_models())
        text += fmt::format("\n  {}: {}", model.name, model.text);
    return text;
}

std::string coupling_help() {
    std::string text = fmt::format(
        "The coupling between the model and the hand ({}; {} with a force model that has no cutting law",
        name_of(usual_coupling(true, devices().front())), name_of(usual_coupling(false, devices().front())));
    for (const DeviceEntry& device : devices())
        if (device.coupling)
            text += fmt::format("; {} with --device {}", entry_of(*device.coupling).name, device.name);
    text += "):";
    for (const CouplingEntry& coupling : couplings())
        text += fmt::format("\n  {}: {}", coupling.name, coupling.text);
    return text +
           "\n  BASE+damper, BASE+passivity: the same with another BASE of those that hold or interpolate";
}

}  // namespace

void declare(CommandOptions& app, TypedServerOptions& typed) {
    ServerOptions& to = typed.options;
    app.add_option(
        "--scene", to.scene.name,
        fmt::format("Scene: a TOML file, or a phantom: {} (tooth; with --bone alone: a cavity on top of that "
                    "bone)",
                    fmt::join(phantom_names, ", ")));
    app.add_option("--case", typed.case_name,
                   fmt::format("Case: a folder that bone_import --case made, or one built in: {}",
                               fmt::join(phantom_names, ", ")))
        .type_name("DIR|NAME")
        .excludes("--scene");
    app.add_option("--bone", to.scene.bone, "Bone from a file that bone_import wrote, instead of the scene's")
        .type_name("FILE.nrrd");
    app.add_texts(
           "--set", typed.changes,
           "A key of the scene, whatever its file says, such as wall_friction=0.3, device.scale=0.5 or "
           "tissues.enamel.cuttable=false (docs/scenes.md); again for each further one")
        .type_name("KEY=VALUE");
    app.add_option("--burr", typed.burr, "The burr to start with, by its name in the scene")
        .type_name("NAME");
    app.add_option("--rpm", to.scene.spindle_rpm, "Spindle speed of every burr, in place of the scene's")
        .check(within(least_spindle_rpm, most_spindle_rpm));
    typed.device.declare(app);
    app.add_option(
           "--grip", typed.grip,
           "How the simulated hand holds the arm; on rails it is where the trajectory has it, whatever the "
           "force")
        .check(one_of({"light", "firm", rails_name}))
        .shows_default();
    app.add_option("--trajectory", to.scene.trajectory,
                   "The motion that the simulated hand follows, instead of the scene's")
        .type_name("FILE.csv");
    app.add_option("--coupling", typed.coupling, coupling_help()).type_name("NAME");
    app.add_option("--force-model", to.milling.force_model, force_model_help())
        .check(one_of(force_model_names()))
        .shows_default();
    app.add_option("--milling-rate-hz", typed.milling_rate_hz,
                   fmt::format("Steps of the milling loop per second, {:.0f} to {:.0f} (1000; 100 where the "
                               "milling force is interpolated, as published)",
                               least_milling_rate_hz, most_milling_rate_hz))
        .check(within(least_milling_rate_hz, most_milling_rate_hz));
    app.add_flag(
        "--vibration", to.milling.vibration,
        "Add what the arm can render of the handpiece's vibration, up to 300 Hz: run-out, once a turn of "
        "the spindle (to 18 000 rpm), and the edges' passing");
    app.add_option("--clock", typed.clock, "real, or virtual: as fast as it can, repeatable to the bit")
        .check(one_of({"real", "virtual"}))
        .shows_default();
    app.add_option("--haptic-cpu", to.milling.haptic_cpu,
                   "Bind the haptic loop to this processor; best one that the kernel keeps free (isolcpus)")
        .check(not_below_zero());
    app.add_option("--milling-cpu", to.milling.milling_cpu, "Bind the milling loop to this processor")
        .check(not_below_zero());
    app.add_option("--duration-s", to.milling.duration_s, "Stop after this long (or at the trajectory's end)")
        .check(above_zero());
    app.add_option("--listen", typed.listen,
                   "Where clients connect, port 0: any free one; \"none\": nobody does (127.0.0.1:7010; none "
                   "with --clock virtual)")
        .type_name("ADDRESS:PORT");
    app.add_flag(
        "--wait-for-client", to.waits_for_client,
        "The session begins, and its time runs, once a client that may operate has drawn the bone or "
        "moves the tool; until then nothing moves");
    app.add_option("--metrics", typed.metrics,
                   "Where Prometheus or curl may ask how the session goes, at /metrics; an address of this "
                   "machine alone, such as 127.0.0.1:9464")
        .type_name("ADDRESS:PORT");
    app.add_texts(
           "--metrics-host", to.metrics_hosts,
           "A name by which the page of --metrics may be asked for, beside localhost and addresses, such as "
           "that of a proxy; once for each name")
        .type_name("NAME");
    app.add_flag("--log-json", to.logs_json,
                 "Standard error, with the log, as one JSON object a line: time, level, message");
    app.add_option("--operators", to.operators,
                   "With --device client and TLS: who may move the tool, others watch; a certificate's "
                   "subject a line, "
                   "whole, as RFC 2253 writes it, such as CN=viewer; # begins a comment")
        .type_name("FILE");
    app.add_option("--controls", to.controls,
                   "Pause, undo, mark and the like at given times, as the window's tool bar does; lines of "
                   "t_s,action,text")
        .type_name("FILE.csv");
    app.add_option("--record", to.record,
                   "Write what a client is sent, for packet_replay and render_client --replay; a pcap file")
        .type_name("FILE");
    app.add_option(
           "--record-rate-hz", typed.record_rate_hz,
           "The rate of a recording: 1000, every tick of the haptic loop (packet_replay --csv is then "
           "the log of --log-csv), or 30, only the states that clients are sent")
        .check(one_of({"1000", "30"}))
        .shows_default();
    app.add_option("--save-bone", to.outputs.save_bone,
                   "Write what is left of the bone, at the end or on a signal; a large CT takes a minute and "
                   "says how "
                   "far it has come")
        .type_name("FILE.nrrd");
    app.add_option(
           "--report", to.outputs.report,
           "Record the session into this folder and, at its end, write its report: report.html, metrics.csv, "
           "metrics.json; a folder that holds a session already is refused")
        .type_name("DIR");
    app.add_option("--language", to.outputs.report_language, "Language of the report")
        .check(one_of(languages()))
        .shows_default();
    app.add_option("--trainee", to.trainee, "Whose session it is, for the recording and the report")
        .type_name("NAME");
    app.add_option("--json", to.outputs.json,
                   "Write what was measured, and with which settings; the histograms that its percentiles "
                   "are from go beside it, into NAME.histograms.json")
        .type_name("FILE");
    app.add_option("--log-csv", to.logs.force, "Write force and depth, a line a millisecond")
        .type_name("FILE");
    app.add_option(
           "--log-milling-csv", to.logs.milling,
           "Write the milling force of every milling step; with --force-model milling-instants at 10 kHz, "
           "the force within the tooth period")
        .type_name("FILE");
    app.add_flag(
        "--measure-arm", typed.measures_arm,
        "Measure the arm of --device with a hand on it: encoder step, noise, delay, moving mass, friction "
        "and the stiffest calm spring; write its profile, and end (docs/hardware.md)");
    app.add_option(save_profile_flag, typed.save_profile,
                   fmt::format("With --measure-arm: where the profile goes, for --device-profile ({})",
                               usual_measured_profile))
        .type_name("FILE.toml");
    app.add_flag(
        "--check", to.checks_machine,
        "Look whether the machine is ready for a session with these options; for everything that is "
        "not ready, print what it costs and how to mend it, and end: 0 where nothing is wrong, else 1");
}

}  // namespace osteomill
