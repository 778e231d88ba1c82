/// Detail of arguments.hpp: what is made of garments and fabrics before a run.
#include "cases/command/arguments.hpp"

#include "cases/cloth/kind_fields.hpp"
#include "cases/command/arguments_shared.hpp"

namespace gambeson {

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
  addThreads(command, a.threads, "Threads, 0 for as many as the machine has [0]; the law does not depend on it");
  command.footer(
      "Nodes are added where cells solved between them differ most from the table, until the errors wanted hold. "
      "Friction between\nyarns is left out: an energy has none.\n\n"
      "Example:\n"
      "  gambeson homogenise cases/library/cell_spun.json -o spun.law.json --e11 -0.01 0.06 --e22 -0.01 0.06\n\n"
      "Exit status: 0 done; 1 a load has no equilibrium, or the errors wanted were not reached (the table is written "
      "then, and says its errors); 2 the case or\nan option is wrong.");
}

}  // namespace gambeson
