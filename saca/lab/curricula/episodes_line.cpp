#include "saca/lab/curricula/episodes_line.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "saca/base/formats/json_text.h"

namespace saca::curricula {

using eval::Episode;
using eval::Episodes;
using nlohmann::json;

std::string line_of(const Episodes& episodes) {
  json line = json::array();
  for (const Episode& one : episodes.of) {
    line.push_back(to_json(one));
  }
  return line.dump();
}

Result<Episodes> episodes_from(const std::string& line, const std::vector<std::uint64_t>& numbers) {
  const auto read = formats::parse_json(line);
  if (!read.has_value()) {
    return read.error();
  }
  if (!read.value().is_array() || read.value().size() != numbers.size()) {
    return Error{Error::Code::malformed,
                 fmt::format("want the episodes of {} seeds", numbers.size())};
  }
  Episodes episodes;
  for (const json& one : read.value()) {
    auto episode = eval::episode_from_json(one);
    if (!episode.has_value()) {
      return episode.error();
    }
    const std::uint64_t number = numbers[episodes.of.size()];
    if (episode.value().row.number != number) {
      return Error{Error::Code::malformed,
                   fmt::format("want encounter {}, got {}", number, episode.value().row.number)};
    }
    episodes.of.push_back(std::move(episode).value());
  }
  return episodes;
}

}  // namespace saca::curricula
