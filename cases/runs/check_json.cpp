#include "cases/runs/check_json.hpp"

#include <nlohmann/json.hpp>

namespace gambeson {

nlohmann::ordered_json checkJson(const std::vector<AuditCheck>& checks) {
  auto list = nlohmann::ordered_json::array();
  for (const AuditCheck& k : checks)
    list.push_back({{"check", k.name},
                    {"value", k.value},
                    {"limit", k.limit},
                    {"unit", k.unit},
                    {"holds", k.holds()},
                    {"meaning", k.meaning},
                    {"wrong", k.holds() ? "" : k.wrong}});
  return list;
}

}  // namespace gambeson
