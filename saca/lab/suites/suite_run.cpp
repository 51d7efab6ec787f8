#include "saca/lab/suites/suite_run.h"

namespace saca::suites {

std::vector<std::string> footnotes_of(const nlohmann::json& meta) {
  std::vector<std::string> lines;
  for (const auto& [key, value] : meta.items()) {
    lines.push_back(key.substr(key.find('.') + 1) + ": " + value.get<std::string>());
  }
  return lines;
}

}  // namespace saca::suites
