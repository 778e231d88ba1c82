#include "cases/runs/together_list.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace gambeson {

using Json = nlohmann::json;

std::string togetherList(const std::vector<TogetherRun>& runs) {
  Json list = Json::array();
  for (const TogetherRun& r : runs)
    list.push_back(
        {{"case", r.case_file.string()}, {"out", r.out.string()}, {"log", r.log.string()}, {"resume", r.resume}});
  return list.dump(1) + "\n";
}

std::vector<TogetherRun> readTogetherList(const std::filesystem::path& file) {
  std::vector<TogetherRun> runs;
  std::ifstream stream(file);
  try {
    for (const Json& r : Json::parse(stream))
      runs.push_back({r.at("case").get<std::string>(), r.at("out").get<std::string>(), r.at("log").get<std::string>(),
                      r.at("resume").get<bool>()});
  } catch (const Json::exception&) {
    throw InputError({file.string(), 0, ""}, "is no list of runs as \"gambeson study\" writes it");
  }
  return runs;
}

std::string eventLine(const TogetherEvent& e) {
  Json j{{"run", e.run}, {"ended", e.ended}};
  if (e.ended) j.update({{"good", e.good}, {"why", e.why}, {"seconds", e.seconds}});
  return j.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<TogetherEvent> readEvent(const std::string& line) {
  const Json j = Json::parse(line, nullptr, false);
  try {
    TogetherEvent e;
    e.run = j.at("run").get<std::size_t>();
    e.ended = j.at("ended").get<bool>();
    if (e.ended)
      e.good = j.at("good").get<bool>(), e.why = j.at("why").get<std::string>(),
      e.seconds = j.at("seconds").get<double>();
    return e;
  } catch (const Json::exception&) {
    return {};
  }
}

}  // namespace gambeson
