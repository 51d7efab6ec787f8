#include "saca/lab/intention_scoring/split.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include "saca/base/core/contract.h"

namespace saca::intention_scoring {
namespace {

/// How much a group holds: rare frames, and all.
struct Weight {
  std::size_t rare = 0;
  std::size_t frames = 0;

  auto operator<=>(const Weight&) const = default;
};

}  // namespace

std::vector<int> parts_of(std::span<const Sequence> sequences, int num_parts) {
  expects(num_parts >= 1, "num_parts >= 1");
  std::map<std::pair<std::string, std::string>, Weight> groups;  // by site and group
  for (const Sequence& sequence : sequences) {
    Weight& weight = groups[{sequence.site, sequence.group}];
    weight.frames += sequence.labels.size();
    weight.rare +=
        static_cast<std::size_t>(std::count_if(sequence.labels.begin(), sequence.labels.end(),
                                               [](std::uint8_t label) { return label != 0; }));
  }
  std::vector<std::tuple<std::string, Weight, std::string>> order;
  order.reserve(groups.size());
  for (const auto& [key, weight] : groups) {
    order.emplace_back(key.first, weight, key.second);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::get<0>(a) != std::get<0>(b) ? std::get<0>(a) < std::get<0>(b)
                                            : std::get<1>(a) > std::get<1>(b);
  });
  std::map<std::pair<std::string, std::string>, int> part_of;
  std::vector<Weight> held(static_cast<std::size_t>(num_parts));
  std::string site;
  for (const auto& [of_site, weight, group] : order) {
    if (of_site != site) {
      held.assign(held.size(), {});
      site = of_site;
    }
    const auto least = std::min_element(held.begin(), held.end());
    least->rare += weight.rare;
    least->frames += weight.frames;
    part_of[{of_site, group}] = static_cast<int>(least - held.begin());
  }
  std::vector<int> parts;
  for (const Sequence& sequence : sequences) {
    parts.push_back(part_of.at({sequence.site, sequence.group}));
  }
  return parts;
}

Split split_off(std::vector<Sequence> sequences, int part, int num_parts) {
  expects(part >= 0 && part < num_parts, "0 <= part < num_parts");
  const std::vector<int> parts = parts_of(sequences, num_parts);
  Split split;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    (parts[i] == part ? split.part : split.rest).push_back(std::move(sequences[i]));
  }
  return split;
}

}  // namespace saca::intention_scoring
