#include "saca/lab/network_training/lessons.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "saca/lab/intention_scoring/forecast_file.h"

namespace saca::network_training {

Result<Lessons> read_lessons(const std::filesystem::path& path,
                             std::span<const intention_scoring::Sequence> sequences,
                             std::span<const intention_scoring::Sequence> held_out) {
  auto read = intention_scoring::read_forecasts(path);
  if (!read.has_value()) {
    return read.error();
  }
  const intention_scoring::ForecastSet set = std::move(read).value();
  const std::set<std::string> names(set.names.begin(), set.names.end());
  const auto is_told = [&](const intention_scoring::Sequence& one) {
    return names.count(one.name) > 0;
  };
  const auto seen = std::find_if(held_out.begin(), held_out.end(), is_told);
  if (seen != held_out.end()) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: want teachers that have not seen what is held out, got forecasts "
                             "of {}, from which those of others have learnt",
                             path.string(), seen->name)};
  }
  std::vector<intention_scoring::Sequence> taught;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < sequences.size(); ++i) {
    if (is_told(sequences[i])) {
      taught.push_back(sequences[i]);
      places.push_back(i);
    }
  }
  if (taught.empty()) {
    return Error{Error::Code::malformed,
                 path.string() + ": want forecasts of sequences to be trained with, got none"};
  }
  auto told = intention_scoring::forecasts_of(set, taught, path.string());
  if (!told.has_value()) {
    return told.error();
  }
  std::vector<intention_scoring::Forecasts> forecasts = std::move(told).value();
  Lessons lessons;
  lessons.forecasts.resize(sequences.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    lessons.forecasts[places[k]] = std::move(forecasts[k]);
  }
  return lessons;
}

}  // namespace saca::network_training
