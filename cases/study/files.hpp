#pragma once
/// What stands in the folder of a study beside the folders of its variants: the one list of names, for those who write
/// these files and for the check that no variant is called like one of them.

#include <array>
#include <string>
#include <string_view>

namespace gambeson::study::files {

inline constexpr std::string_view report = "report.html", numbers = "study.json", variants = "variants.csv",
                                  curves = "curves.csv", exponents = "exponents.csv", elasticities = "elasticities.csv",
                                  population = "population.csv", meshes = "meshes.csv", uncertainty = "uncertainty.csv",
                                  maps = "maps.csv", script = "study.slurm", compare_script = "compare.slurm",
                                  compare_log = "compare.log", submit = "submit.sh";
/// Folders.
inline constexpr std::string_view cases = "cases", logs = "logs", pictures = "pictures";

inline constexpr std::array written{report,    numbers,        variants,    population,  curves,
                                    exponents, elasticities,   meshes,      uncertainty, maps,
                                    script,    compare_script, compare_log, submit};
inline constexpr std::array folders{cases, logs, pictures};

/// What the picture of a variant is called (in the folder of pictures): its wish counts from 0.
std::string pictureName(const std::string& variant, std::size_t wish);

/// Why a folder of a variant cannot be called `name`; empty where it can. Letters count alike whether small or
/// capital, as some file systems have it; names that begin with a dot are kept for what is hidden.
std::string unfitFolder(const std::string& name);

}  // namespace gambeson::study::files
