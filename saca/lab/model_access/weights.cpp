#include "saca/lab/model_access/weights.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <fstream>

#include "saca/base/config/config.h"
#include "saca/base/core/file.h"
#include "saca/base/core/fnv.h"
#include "saca/thinking/language_model/child_model.h"

namespace saca::model_access {

Result<double> temperature_of(const std::filesystem::path& file, const std::string& weights) {
  const auto text = read_file(file);
  if (!text.has_value()) {
    return text.error();
  }
  const auto document = config::Document::parse(text.value(), file.string());
  if (!document.has_value()) {
    return document.error();
  }
  double found = 1.0;
  for (config::Table& each : document.value().root().tables("weights")) {
    const std::string name = each.text("name");
    const double temperature = each.number("temperature", {0.05, 20.0});
    if (weights.starts_with(name)) {
      found = temperature;
    }
  }
  if (const auto problem = document.value().error()) {
    return *problem;
  }
  return found;
}

std::string fingerprint(const AnsweringModel& model) {
  constexpr std::streamoff looked_at = 1 << 16;
  std::ifstream file(model.weights, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  std::string bytes(looked_at, '\0');
  Fnv hash;
  hash.add(static_cast<std::uint64_t>(size));
  for (const std::streamoff from : {std::streamoff{0}, std::max(size - looked_at, looked_at)}) {
    file.clear();
    file.seekg(from);
    file.read(bytes.data(), looked_at);
    hash.add(std::string_view(bytes).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  hash.add(model.system);
  hash.add(std::bit_cast<std::uint64_t>(model.temperature));
  hash.add(static_cast<std::uint64_t>(model.flash_attention));
  hash.add(static_cast<std::uint64_t>(language_model::ChildModelSettings{}.max_tokens));
  return fmt::format("{:08x}", hash.value() >> 32U);
}

}  // namespace saca::model_access
