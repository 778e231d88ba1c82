#include "cases/command/arguments.hpp"

#include <map>

#include "cases/cloth/kind_fields.hpp"
#include "cases/runs/options.hpp"
#include "cases/runs/picture.hpp"

namespace gambeson {

static void addOverrides(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option("--set", overrides,
                  "Replaces a value of the case, for instance fabric.thickness=\"0.4 mm\" or "
                  "output.pictures[0].time=peak; may be given several times")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
}

static void addDevice(CLI::App& command, std::string& device) {
  command
      .add_option(
          "--device", device,
          "What computes the steps. cpu: the processor; cuda: an NVIDIA GPU, for fine cloth; "
          "reference: the processor, slowly, with every bit as cuda has it; auto: cpu on every machine, so that "
          "numbers do not depend on it, and a note where a GPU is there [auto]")
      ->type_name("DEVICE")
      ->check(CLI::IsMember({"auto", "cpu", "reference", "cuda"}).description(""));
}

void addTables(CLI::App& command, std::string& csv) {
  command
      .add_option("--csv", csv,
                  "european: each table also with semicolons and decimal commas, as european/NAME.csv beside it")
      ->type_name("FORM")
      ->check(CLI::IsMember({"european"}).description(""));
}

void addRun(CLI::App& app, RunArguments& a) {
  CLI::App& run =
      *app.add_subcommand("run",
                          "Runs a case: dresses the human, lets it move, measures, takes pictures, reports; or "
                          "solves a static, dynamic or modal case of a structure; or takes a cell of yarns through "
                          "loads");
  run.add_option("CASE", a.file, "Case file (JSON)")->type_name("")->required();
  run.add_option(
         "--out", a.options.out,
         "Folder for the results; an earlier run's results there are replaced [results/<name of the case file>]")
      ->type_name("DIR");
  run.add_option(
         "--threads", a.options.threads,
         "Threads, 0 for OMP_NUM_THREADS or else as many as the machine has [0]. The results do not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
  run.add_flag("--resume", a.options.resume,
               "Continues an interrupted run of the same case, in the same folder, from its last checkpoint; of cuda "
               "also under reference, and the other way round");
  addOverrides(run, a.overrides);
  addDevice(run, a.device);
  run.footer(
      "Time goes with the size of cells (garment.NAME.cell): a walk takes minutes with 50 mm and most of an hour with "
      "20; half\n"
      "the size takes some ten times as long. Run gambeson check first, stand before you walk, and walk coarse before "
      "fine.\n\n"
      "Leaves in DIR: report.html (start here), summary.json (all numbers), torques.csv, contact.csv, zones.csv,\n"
      "stress.csv, patches.csv, straps.csv, collisions.csv, energy.csv, memory.csv, latitude.csv, snapshots/\n"
      "(pictures; where the case names none also film.mp4) and frames.xdmf (the recording, for ParaView). Static,\n"
      "dynamic and modal cases leave path.csv (points and edges of each step) and\n"
      "shape.csv (the last shape) in place of these tables, cells of yarns curves.csv.\n\n"
      "Examples:\n"
      "  gambeson run cases/library/shorts_walk.json\n"
      "  gambeson run cases/library/shorts_walk.json --out results/thin --set fabric.thickness=\"0.4 mm\"\n"
      "  gambeson run cases/library/sleeve_flex.json --set contact.friction=0.5\n"
      "  gambeson run cases/library/cantilever.json --set sheet.cells_u=32\n"
      "  gambeson run cases/library/armour_walk.json --device cuda\n\n"
      "Exit status: 0 done; 1 the run failed, the message says why; 2 something in the input is wrong.");
}

void addDress(CLI::App& app, DressArguments& a) {
  CLI::App& command =
      *app.add_subcommand("dress", "Puts the garments of a case on its human, for many runs to start from");
  command.add_option("CASE", a.file, "Case file (JSON)")->type_name("")->required();
  command.add_option("-o,--output", a.output, "Dressed state to write (JSON)")->type_name("FILE")->required();
  command
      .add_option(
          "--threads", a.threads,
          "Threads, 0 for OMP_NUM_THREADS or else as many as the machine has [0]. The state does not depend on it")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
  addOverrides(command, a.overrides);
  command.footer(
      "Examples:\n"
      "  gambeson dress armour.json -o dressed.json\n"
      "  gambeson run armour.json --set dressing.from=dressed.json\n\n"
      "Exit status: 0 done; 1 a garment could not be put on, the message says why; 2 something in the input is wrong.");
}

void addCheck(CLI::App& app, CheckArguments& a) {
  CLI::App& check = *app.add_subcommand("check", "Checks a case, or another file, without running it");
  check
      .add_option(
          "CASE", a.file,
          "Case file (JSON); not needed with --schema or --doc. Of a study, card, law, garment, pattern, motion, "
          "mesh or folder of results it says what it is and whether it is sound")
      ->type_name("");
  addOverrides(check, a.overrides);
  check.add_flag("--full", a.full, "Prints the case with all defaults written out, in SI");
  check.add_flag("--schema", a.schema,
                 "Prints the JSON Schema of cases, for editors that complete and check while you write");
  check.add_flag("--doc", a.doc, "Prints what every field of a case means (Markdown)");
  check.footer(
      "Examples:\n"
      "  gambeson check my_case.json\n"
      "  gambeson check my_case.json --full --set garment.shorts.ease=\"10 %\"\n"
      "  gambeson check --schema > case.schema.json\n\n"
      "Exit status: 0 the case is valid: all that a run starts from was built; 1 the body cannot be freed of the "
      "garment; 2 it "
      "is not valid, and the message says file, line, key and what is allowed.");
}

void addNew(CLI::App& app, NewCase& a) {
  CLI::App& command = *app.add_subcommand(
      "new", "Writes a case that runs, from five answers: options, or else questions where this is a terminal");
  command.add_option("CASE", a.file, "File to write [GARMENT_MOTION.json]")->type_name("");
  command
      .add_option("--garment", a.garment,
                  "What is worn: shorts, trousers, shirt, sleeves (a shirt with long ones), or a pattern's file that "
                  "gambeson import wrote [shorts]")
      ->type_name("GARMENT");
  command
      .add_option("--fabric", a.fabric,
                  "A card of the library (denim_a, petrak_m6_cotton_twill, ...) or a card's file [denim_a]")
      ->type_name("CARD");
  command
      .add_option("--wearer", a.wearer,
                  "male_p5, male_p50, male_p95, female_p5, female_p50, female_p95, or a body scan's file (.obj, .ply) "
                  "[male_p50]")
      ->type_name("WEARER");
  command.add_option("--motion", a.motion, "stand, walk, stairs, step_over, sit or aim [stand]")->type_name("MOTION");
  command
      .add_option("--cells", a.cells, "coarse, medium or fine: fine takes some ten times as long as coarse [coarse]")
      ->type_name("CELLS");
  command.footer(
      "The case is checked on its wearer as it is written. Its file is small and meant to be edited "
      "(cases/FIELDS.md).\n\n"
      "Examples:\n"
      "  gambeson new                                                     asks\n"
      "  gambeson new walk.json --garment trousers --wearer female_p50 --motion walk\n"
      "  gambeson new --garment shirt_pattern.json --fabric poplin.card.json --wearer scan.obj");
}

void addDraft(CLI::App& app, DraftArguments& a) {
  CLI::App& draft = *app.add_subcommand(
      "draft", "Writes a garment of a case, made on its human, as a file that can be edited and worn");
  draft.add_option("CASE", a.file, "Case file (JSON)")->type_name("")->required();
  draft.add_option("--garment", a.garment, "Its name in the case; not needed where there is only one")
      ->type_name("NAME");
  addOverrides(draft, a.overrides);
  draft.add_flag("--obj", a.obj, "A mesh of triangles in place of its patches, as a name that ends in .obj says too");
  draft.add_flag("--flat", a.flat, "Flat panels at 1:1 (DXF, SVG, or a pattern in JSON)");
  draft
      .add_option(
          "-o,--output", a.garment_file,
          "File to write, as its name ends: .json its patches, .obj a mesh of triangles; with --flat .dxf, .svg "
          "or .json")
      ->type_name("GARMENT")
      ->required();
  draft.footer(
      "The file has patches, seams, trims and names of edges, but no fabric; {\"file\": {\"path\": ...}} in a case\n"
      "wears it, with the same results to the bit. An OBJ has the triangles that the garment is made of with\n"
      "\"model\": \"triangles\" (and its \"mesh\"); {\"mesh_file\": {\"path\": ...}} wears these.\n"
      "With --flat each patch is laid flat, without seam allowance, and what that strains it is said: panels with\n"
      "grain, notches and seams, which gambeson import reads again.\n\n"
      "Examples:\n  gambeson draft cases/library/armour_stand.json --garment shirt -o shirt.json\n"
      "  gambeson draft cases/library/shorts_walk.json --flat -o shorts.dxf");
}

void addImport(CLI::App& app, ImportArguments& a) {
  CLI::App& import = *app.add_subcommand(
      "import",
      "Reads the pattern of another program: flat panels and what is sewn to what, as a file and as a drawing");
  import
      .add_option(
          "FILE", a.file,
          "specification.json of GarmentCode, DXF-AAMA or ASTM D6673 (.dxf), surfaces of CAD programs (.step, .stp, "
          ".igs, .iges, .brep), a garment of triangles (.obj, .ply), or what this command wrote")
      ->type_name("")
      ->required();
  import.add_option("-o,--output", a.output, "Pattern, patches or mesh to write (JSON)")->type_name("GARMENT");
  import.add_option("--svg", a.svg, "Drawing to write (SVG): 1:1 in mm, with edges by number and seams by colour")
      ->type_name("PATTERN");
  import
      .add_option(
          "--unit", a.choices.unit,
          "Unit of the file's lengths, in place of the one that it says or where it says none (of CAD files: where it "
          "says none): mm, cm, in ..")
      ->type_name("UNIT");
  import.add_option("--up", a.choices.up, "Which axis of a mesh is up, y or z [z, as gambeson writes OBJ]")
      ->type_name("AXIS");
  import
      .add_option("--piece", a.choices.piece, "Which of the pieces of a mesh that hang together nowhere, 1 the largest")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  import.add_option("--size", a.choices.size, "Which size of a graded DXF pattern [its SAMPLE SIZE]")
      ->type_name("SIZE");
  import.add_flag("--unfold", a.choices.unfold,
                  "Halves of DXF pieces that are drawn up to their mirror line are made whole");
  import.footer(
      "Prints the panels with their areas, the seams with the lengths of their sides, and what the file says that is "
      "not\nkept. DXF has no seams: they are proposed by length and notches. Mend them in \"seams\" of GARMENT, where "
      "a side is\n\"front.3\", \"front.3 reversed\" or \"front.3 from 0.25 to 1\" (panel, edge, part of its length), "
      "and "
      "draw it again.\nOf CAD files each face is a panel where all are planes, and a trimmed patch of a garment (for "
      "garment.file) where one is curved;\nedges that faces share are their seams. Of meshes groups or materials are "
      "patches, uv is how they lie flat where its lengths fit,\nand borders are edges by name (for "
      "garment.mesh_file).\n\n"
      "Examples:\n"
      "  gambeson import shirt_specification.json -o shirt.json --svg shirt.svg\n"
      "  gambeson import blouse.dxf -o blouse.json --svg blouse.svg\n"
      "  gambeson import blouse.dxf -o blouse.json --unit in --size M\n"
      "  gambeson import blouse.json --svg blouse.svg\n"
      "  gambeson import bodice.step -o bodice.json");
}

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

/// The words of a choice as a case has them.
template <class E>
static std::vector<std::string> wordsOf(const std::vector<std::pair<std::string, E>>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.push_back(word);
  return words;
}

void addFabric(CLI::App& app, FabricArguments& a) {
  CLI::App& command = *app.add_subcommand(
      "fabric",
      "Makes a fabric of a laboratory's card (KES, FAST, D1388), and measures it again in a virtual "
      "laboratory");
  command.add_option("CARD", a.options.card, "Fabric card (JSON), or the name of one of the library")
      ->type_name("")
      ->required();
  command
      .add_option("-o,--output", a.options.fabric,
                  "Writes the fabric as cases have it, with where each number is from (JSON); the laboratory stays "
                  "closed unless --out is given too")
      ->type_name("FABRIC");
  command
      .add_option("--out", a.options.out,
                  "Folder for what the laboratory measures [results/<name of the card>, without -o]")
      ->type_name("DIR");
  command
      .add_option(
          "--test", a.tests,
          "bending (KES-FB2, to 2.5/cm either way), shear (KES-FB1, to 8 degrees), tension (KES-FB1), bias "
          "(FAST-3, EB5), cantilever (ASTM D1388) or drape (Cusick, about a minute); may be given several times [those "
          "whose numbers the card has]")
      ->type_name("TEST")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"bending", "shear", "tension", "bias", "cantilever", "drape"}).description(""));
  command
      .add_option("--direction", a.options.directions_deg,
                  "Direction that the specimen is cut in, degrees from the weft towards the warp; may be given several "
                  "times [0, and 90 where the card tells weft and warp apart; bias 45]")
      ->type_name("DEG")
      ->allow_extra_args(false)
      ->check(CLI::Range(-360., 360.).description(""));
  command
      .add_option("--model", a.model,
                  "What the specimen is made of: " + schema::joined(wordsOf(schema::specimenKinds())))
      ->type_name("MODEL")
      ->capture_default_str()
      ->check(CLI::IsMember(wordsOf(schema::specimenKinds())).description(""));
  command.add_option("--mesh", a.mesh, "Of triangles: " + schema::joined(wordsOf(schema::meshKinds())))
      ->type_name("MESH")
      ->capture_default_str()
      ->check(CLI::IsMember(wordsOf(schema::meshKinds())).description(""));
  command
      .add_option("--bending-elements", a.bending,
                  "What bends triangles: " + schema::joined(wordsOf(schema::bendingElements())))
      ->type_name("NAME")
      ->capture_default_str()
      ->check(CLI::IsMember(wordsOf(schema::bendingElements())).description(""));
  command
      .add_option("--cells", a.options.specimen.cells,
                  "Cells between the clamps; a draped ring has half of them across and six times as many around")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(4, 200).description(""));
  command.add_option("--degree", a.options.specimen.degree, "Degree of NURBS")
      ->type_name("P")
      ->capture_default_str()
      ->check(CLI::Range(2, 5).description(""));
  command
      .add_option(
          "--fit", a.options.loop,
          "Measured points (JSON): finds EMT, LT, G, 2HG, B, 2HB from them by least squares, with error bars, in "
          "place of the card's. Or a raw loop of bending (CSV with the columns curvature_per_cm or _per_m, and "
          "moment_gf_cm_per_cm, moment_N or moment_mN): finds its stops and bends the fabric by them")
      ->type_name("FILE");
  command.footer(
      "A card has the numbers of a laboratory, each with its unit:\n"
      "  {\"name\": \"Denim A\", \"source\": \"our laboratory, 2026\", \"thickness\": \"1.066 mm\",\n"
      "   \"bending\": {\"B\": \"0.172 gf cm^2/cm\", \"2HB\": \"0.139 gf cm/cm\", \"2HB_at\": \"1 1/cm\"},\n"
      "   \"shear\": {\"G\": \"2.18 gf/(cm deg)\"}, \"tensile\": {\"EMT\": \"5.5 %\"}}\n"
      "All keys: cases/FIELDS.md, Fabric cards. What the card lacks is assumed, and said. A case takes the fabric by\n"
      "\"fabric\": {\"card\": \"denim_a\"} (a file, or a name of the library), or by what -o writes.\n"
      "Leaves in DIR, for each test and direction: bending_0.csv and its like (what was measured), bending_0.svg (the\n"
      "same beside the card's numbers), and laboratory.json (all numbers).\n\n"
      "Examples:\n"
      "  gambeson fabric denim_a\n"
      "  gambeson fabric cases/library/cards/denim_a.card.json -o denim_a.json\n"
      "  gambeson fabric denim.card.json --test bending --direction 22.5 --model triangles --cells 16\n"
      "  gambeson fabric denim.card.json --fit measured.csv -o denim.json --out results/denim\n\n"
      "Exit status: 0 done; 1 a test failed, the message says why; 2 something in the input is wrong.");
}

void addHomogenise(CLI::App& app, HomogeniseArguments& a) {
  CLI::App& command = *app.add_subcommand(
      "homogenise",
      "Makes the law of a cloth from a cell of its yarns (a case of kind cell): its energy by strain and its bending "
      "rigidity, as a table that a fabric takes");
  command.add_option("CELL", a.file, "Case of kind cell (JSON)")->type_name("")->required();
  command.add_option("-o,--output", a.law, "The law (JSON), for \"fabric\": {\"law\": {\"table\": \"LAW\"}}")
      ->type_name("LAW")
      ->required();
  addOverrides(command, a.overrides);
  const auto range = [&](const char* option, std::array<double, 2>& ends, const std::string& what) {
    command.add_option(option, ends, what)->type_name("LOW HIGH")->capture_default_str();
  };
  range("--e11", a.e11, "Strain along the weft (Green-Lagrange), with 0 inside or at an end");
  range("--e22", a.e22, "Strain along the warp");
  range("--e12", a.e12, "Shear strain");
  command
      .add_option("--tension-error", a.tension_error,
                  "Error of the tensions that is wanted, as a part of the largest in the range")
      ->type_name("PART")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1.).description(""));
  command.add_option("--shear-error", a.shear_error, "Error of the shear that is wanted, as a part of the largest")
      ->type_name("PART")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 1.).description(""));
  command.add_option("--nodes", a.most_nodes, "Nodes of the table, at most: cells that are solved for it")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(100, 1000000).description(""));
  command.add_flag("--rigidity-at-rest", a.rigidity_at_rest,
                   "Takes the bending rigidity of the cell at rest for all strains, in place of one by strain");
  command.add_flag("--shrink", a.shrink,
                   "Makes the range smaller where a load has no stable equilibrium, in place of ending there");
  command
      .add_option("--threads", a.threads, "Threads, 0 for as many as the machine has; the law does not depend on it")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(0, 4096).description(""));
  command.footer(
      "Nodes are added where cells solved between them differ most from the table, until the errors wanted hold. "
      "Friction between\nyarns is left out: an energy has none.\n\n"
      "Example:\n"
      "  gambeson homogenise cases/library/cell_spun.json -o spun.law.json --e11 -0.01 0.06 --e22 -0.01 0.06\n\n"
      "Exit status: 0 done; 1 a load has no equilibrium, or the errors wanted were not reached (the table is written "
      "then, and says its errors); 2 the case or\nan option is wrong.");
}

void addVerify(CLI::App& app, verify::Options& o) {
  CLI::App& command =
      *app.add_subcommand("verify", "Runs published references: measured against reference, tolerance, on one page");
  command.add_option("--filter", o.filters, "Only references whose id fits the pattern, such as 'sze_*' [all]")
      ->type_name("GLOB")
      ->allow_extra_args(false);
  command.add_flag("--quick", o.quick, "Only the quick half");
  command.add_option("--dir", o.dir, "Folder of the references [tests/verify]")->type_name("DIR");
  command.add_option("--out", o.out, "Folder for the results [results/verify]")->type_name("DIR");
  command
      .add_option("--results", o.results,
                  "Takes runs from here (DIR/REFERENCE/RUN or DIR/RUN) that are complete and of the same case, instead "
                  "of running them; runs that were interrupted in the folder of --out go on")
      ->type_name("DIR");
  command.add_option("--jobs", o.jobs, "Runs at a time, of one thread each; 0 for one on each core [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
  command.footer(
      "Leaves in DIR: verify.html (start here), verify.json and a folder for each run.\n\n"
      "Examples:\n"
      "  gambeson verify --quick\n"
      "  gambeson verify --filter 'sze_3_4*' --out results/hemisphere\n"
      "  gambeson verify --filter armour --out results/armour --results results/armour\n\n"
      "Exit status: 0 all references passed; 1 some failed; 2 something in the input is wrong.");
}

static void addSlurm(CLI::App& command, StudyArguments& a) {
  command
      .add_option("--engine", a.engine,
                  "local: runs here; slurm: runs nothing and writes scripts for Slurm into DIR, an array of jobs "
                  "(study.slurm; with --device cuda each asks for a GPU), a job that compares (compare.slurm), and "
                  "submit.sh, which hands both in [local]")
      ->type_name("ENGINE")
      ->check(CLI::IsMember({"local", "slurm"}).description(""));
  const auto add = [&](const char* option, std::optional<std::string>& text, const char* type, const char* what) {
    command.add_option(option, text, what)->type_name(type);
  };
  study::Queue& q = a.options.queue;
  add("--time", q.time, "TIME", "With slurm: time that each job may take, such as 02:30:00 or 1-12 (days-hours)");
  add("--mem", q.memory, "SIZE", "With slurm: memory of each job, such as 8G");
  add("--partition", q.partition, "NAME", "With slurm: partition of the cluster");
  add("--job-name", q.job_name, "NAME", "With slurm: name of the jobs; the one that compares is NAME_compare");
  CLI::Option* compare = command.add_flag("--compare", a.options.compare,
                                          "Runs nothing: compares what is done in DIR, and lists the others as failed");
  for (const char* other : {"--engine", "--jobs", "--resume"}) compare->excludes(command.get_option(other));
}

/// How much runs at once, of options that have both; `elsewhere`, `each`: what 0 jobs mean on a GPU and with Slurm, and
/// what threads with Slurm.
template <class Options>
static void addParallel(CLI::App& command, Options& o, const std::string& elsewhere = "",
                        const std::string& each = "") {
  command.add_option("--jobs", o.jobs, "Runs at a time; 0 for as many as there are threads" + elsewhere + " [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
  command
      .add_option("--threads", o.threads,
                  "Threads of all runs together, 0 for as many as the machine has" + each + " [0]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096).description(""));
}

static void addJobs(CLI::App& command, study::Options& o) {
  addParallel(command, o, ", on a GPU for 16 as far as its memory goes, with slurm for as many as the cluster starts",
              "; with slurm those of each job, 0 for one");
  command.add_flag("--resume", o.resume,
                   "Keeps runs that are done with the same case, continues those that were interrupted, and runs the "
                   "others; without it all run again");
}

void addStudy(CLI::App& app, StudyArguments& a) {
  CLI::App& command = *app.add_subcommand(
      "study",
      "Runs the variants of a case side by side and compares them: which one to take, why, and how sure that is");
  command.add_option("STUDY", a.file, "Study file (JSON)")->type_name("")->required();
  command.add_option("--out", a.options.out, "Folder for the results [results/<name of the study file>]")
      ->type_name("DIR");
  addJobs(command, a.options);
  addDevice(command, a.device);
  addSlurm(command, a);
  command.add_flag("--check", a.check, "Only checks the study and all its variants, and lists them");
  command.footer(
      "Leaves in DIR: report.html (start here), study.json (all numbers), variants.csv (a row for each variant), "
      "curves.csv\n"
      "(torques over time), exponents.csv, elasticities.csv, meshes.csv, uncertainty.csv, pictures/, logs/, and a folder with the run "
      "of\n"
      "each variant.\n\n"
      "Examples:\n"
      "  gambeson study cases/library/shorts_thickness.study.json\n"
      "  gambeson study my.study.json --out results/mine --jobs 4 --resume\n"
      "  gambeson study my.study.json --out results/mine --engine slurm --threads 2 --time 02:30:00 --mem 8G\n"
      "  bash results/mine/submit.sh            what is left goes on with the same two lines and --resume\n\n"
      "Exit status: 0 all variants are done; 1 some failed, and the report compares the others; 2 something in the "
      "input\n"
      "of any variant is wrong, and nothing ran.");
}

void addBatch(CLI::App& app, StudyArguments& a) {
  CLI::App& command =
      *app.add_subcommand("batch", "Runs several cases as a study does, each in a folder named after its file");
  command.add_option("CASE", a.cases, "Case files (JSON)")->type_name("")->required();
  command.add_option("--out", a.options.out, "Folder for the results")->type_name("DIR")->required();
  addJobs(command, a.options);
  addDevice(command, a.device);
  addSlurm(command, a);
  command.footer(
      "Examples:\n"
      "  gambeson batch cases/library/flag.json cases/library/stack_mixed.json --out results/cloth\n"
      "  gambeson batch a.json b.json --out results/ab --engine slurm --time 60 && bash results/ab/submit.sh\n\n"
      "Exit status: 0 all cases are done; 1 some failed; 2 something in the input is wrong, and nothing ran.");
}

void addGallery(CLI::App& app, gallery::Options& o) {
  CLI::App& command = *app.add_subcommand(
      "gallery", "Makes a page of many cases: of each its picture, its question, its answer, and a link to its report");
  command.add_option("CASE", o.files, "Case and study files (JSON) [all of the library]")->type_name("");
  command.add_option("-o,--out", o.out, "Folder for the page and the results")->type_name("DIR")->required();
  command
      .add_option(
          "--library", o.library,
          "Folder of cases, where none is named [share/gambeson/library or cases/library, beside the program or "
          "above it]")
      ->type_name("DIR");
  addParallel(command, o);
  command.footer(
      "Runs what is not done yet, each in DIR/NAME: results of the same case are taken as they are, and runs that "
      "were\n"
      "interrupted go on. Leaves DIR/gallery.html (start here), logs/ and a folder for each. The whole library takes\n"
      "hours.\n\n"
      "Examples:\n"
      "  gambeson gallery cases/library/cantilever.json cases/library/cell_twill.json -o results/gallery\n"
      "  gambeson gallery -o results/library --jobs 2                              the whole library\n\n"
      "Exit status: 0 all are done; 1 some failed, and the page shows why beside the others; 2 something in the input "
      "is\nwrong, and nothing ran.");
}

void addTogether(CLI::App& app, TogetherArguments& a) {
  CLI::App& command = *app.add_subcommand("together", "Makes the steps of a study's runs in one process")->group("");
  command.add_option("LIST", a.options.list)->required();
  command.add_option("--ended", a.options.ended)->required();
  command.add_option("--jobs", a.options.jobs)->check(CLI::Range(1, 4096));
  command.add_option("--threads", a.options.threads)->check(CLI::Range(1, 4096));
  addDevice(command, a.device);
}

void addResults(CLI::App& app, FinishOptions& o) {
  CLI::App& command = *app.add_subcommand("results", "Makes the results of a run from its recording")->group("");
  command.add_option("DIR", o.out)->required();
  command.add_option("--threads", o.threads)->check(CLI::Range(1, 4096));
}

}  // namespace gambeson
