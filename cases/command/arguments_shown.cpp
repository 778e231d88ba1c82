/// Detail of arguments.hpp: what is made of the results of a run.
#include "cases/command/arguments.hpp"

#include <map>

#include "cases/command/arguments_shared.hpp"
#include "cases/runs/picture.hpp"

namespace gambeson {

void addRender(CLI::App& app, RenderArguments& a) {
  CLI::App& render = *app.add_subcommand("render", "Takes a picture or a film of recorded results");
  render
      .add_option("RESULTS", a.request.results,
                  "Folders that gambeson run left; up to four are shown beside each other")
      ->type_name("")
      ->required();
  render.add_option("-o,--output", a.request.output, "What to write: a picture (.png) or a film (.mp4, .webm, .gif)")
      ->type_name("FILE")
      ->required();
  render
      .add_option(
          "--field", a.field,
          "What the colours show: stress (of a mode: its displacement), pressure, strain, thickness, set or friction "
          "(of cloth that remembers), body_pressure (the bare body: the largest pressure of the motion) or plain")
      ->type_name("FIELD")
      ->capture_default_str();
  render
      .add_option("--time", a.time,
                  "Of a picture: a time such as 1.2 or \"1200 ms\" (static: a load factor, modal: a mode); or peak "
                  "(largest joint torque) or end [end]")
      ->type_name("TIME");
  const std::map<std::string, std::pair<const char*, const char*>> about{
      {"from", {"TIME", "Of a film: where it begins [the motion's start]"}},
      {"to", {"TIME", "Of a film: where it ends [the last frame]"}},
      {"fps", {"NUMBER", "Of a film: frames a second, each the nearest recorded one [as recorded, at most 30]"}},
      {"azimuth", {"ANGLE", "From where, in degrees from the front to the left of the body, in place of the view's"}},
      {"elevation", {"ANGLE", "From where, in degrees above the horizon, in place of the view's"}},
      {"zoom", {"NUMBER", "How much larger than what frames --around (0.5: half as large) [1]"}}};
  for (auto& [name, text] : a.numbers)
    render.add_option(std::string("--") + name, text, about.at(name).second)->type_name(about.at(name).first);
  render.add_flag("--follow", a.request.follow, "Of a film: the camera goes along with the pelvis");
  render.add_option("--range", a.range, "Ends of the colours in the unit of their bar [0 and 99 % of the motion]")
      ->type_name("LOW HIGH")
      ->expected(2);
  render.add_option("--view", a.view, "From where: " + schema::joined(viewNames()))
      ->type_name("VIEW")
      ->capture_default_str();
  render
      .add_option(
          "--around", a.around,
          "What is framed: the wearer from head to foot, or closer, the garment alone: wearer, garment [wearer]")
      ->type_name("WHAT");
  render.add_option("--size", a.size, "Pixels, width x height")->type_name("WxH")->capture_default_str();
  render.footer(
      "gambeson check RESULTS says how many frames are recorded, and from when to when; a time between two shows the\n"
      "nearest.\n\n"
      "Examples:\n"
      "  gambeson render results/shorts_walk -o peak.png --time peak\n"
      "  gambeson render results/shorts_walk -o back.png --field pressure --view back --time 1.35 --size 1920x1080\n"
      "  gambeson render results/shorts_walk -o walk.mp4 --follow --size 960x720\n"
      "  gambeson render results/shorts_walk -o knee.webm --from 0.4 --to 1 --azimuth 70 --elevation 5 --zoom 2 "
      "--range 0 300\n"
      "  gambeson render results/thin results/thick -o both.gif --field pressure --size 960x540 --fps 10");
}

void addReport(CLI::App& app, ReportOptions& options) {
  CLI::App& report = *app.add_subcommand("report", "Writes the report page of recorded results again");
  report.add_option("RESULTS", options.results, "Folder that gambeson run left")->type_name("")->required();
  report.add_option("-o,--output", options.html, "Page to write: one file (.html) that needs no other")
      ->type_name("HTML")
      ->required();
  report.footer("Example:\n  gambeson report results/shorts_walk -o shorts.html");
}

void addExport(CLI::App& app, ExportArguments& a) {
  CLI::App& command =
      *app.add_subcommand("export", "Writes recorded results for other programs: animations, CAD and OpenSim");
  command.add_option("RESULTS", a.options.results, "Folder that gambeson run left")->type_name("")->required();
  std::string endings;
  for (const ExportFormat& f : exportFormats())
    endings += (endings.empty() ? "" : "; ") + schema::joined(f.endings) + " " + f.what;
  command.add_option("-o,--output", a.files, "File to write, as its name ends: " + endings)->type_name("FILE ...");
  command
      .add_option(
          "--iges", a.options.iges,
          "The garment at one time as NURBS surfaces with their trimming: IGES 5.3 (.igs, .iges), in millimetres, as "
          "recorded (single precision)")
      ->type_name("FILE");
  command
      .add_option("--step", a.options.step,
                  "The same as shells whose faces are sewn (within 0.01 mm): STEP AP214 (.step, .stp), in millimetres")
      ->type_name("FILE");
  command
      .add_option("--time", a.time,
                  "Of CAD, and of the colours of an animation: a time such as 1.2 or \"1200 ms\", peak (largest joint "
                  "torque) or end [peak for colours, end for CAD]")
      ->type_name("TIME");
  command
      .add_option(
          "--field", a.field,
          "What the colours of an animation show: stress, pressure, strain, thickness, set, friction or plain; the "
          "scale is that of pictures")
      ->type_name("FIELD")
      ->capture_default_str();
  command
      .add_option("--frames", a.options.frames,
                  "Of animations: at most so many frames, evenly; of a .glb fewer where it would have more than 100 MB "
                  "[all of the motion]")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  command
      .add_option(
          "--opensim", a.options.opensim,
          "What the cloth does to the body, window by window: OpenSim's ExternalLoads PREFIX.xml and their data "
          "PREFIX.mot, in ground (x forward, y up); the body as a model, PREFIX.osim, and its coordinates at the same "
          "times, PREFIX_motion.mot")
      ->type_name("PREFIX");
  command.footer(
      "Animations: links of the body are nodes that carry its shapes or its skin; a garment has one morph target for "
      "each\n"
      "frame, in whole numbers of 16 bits, and the command says how far that is from the recording. OBJ has z up.\n\n"
      "Forces act at the origins of the body's links (joint centres) with their moments about these. Links of our "
      "manikins\n"
      "are called as the bodies of gait2392 and Rajagopal's model: thigh_left is femur_l.\n\n"
      "Examples:\n"
      "  gambeson export results/shorts_walk -o walk.glb --field pressure\n"
      "  gambeson export results/shorts_walk -o frames/walk.obj --frames 40\n"
      "  gambeson export results/shorts_walk -o shorts.step --time peak\n"
      "  gambeson export results/shorts_walk --opensim loads/shorts\n"
      "  gambeson export results/shorts_walk --csv european\n\n"
      "Exit status: 0 done; 1 the results could not be written; 2 something in the input is wrong.");
}

}  // namespace gambeson
