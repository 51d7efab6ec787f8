#include "saca/lab/intention_scoring/forecast_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "saca/base/core/contract.h"
#include "saca/base/formats/checksummed_hdf5.h"
#include "saca/base/formats/hdf5_reader.h"
#include "saca/base/formats/hdf5_rows.h"
#include "saca/base/formats/hdf5_writer.h"

namespace saca::intention_scoring {
namespace {

namespace fs = std::filesystem;
using formats::Hdf5Reader;
using formats::Hdf5Writer;

constexpr std::string_view forecasts_format = "saca.forecasts/1";

/// Heads one after the other, each with all frames; classes fastest.
std::vector<double> probabilities_of(const ForecastSet& set) {
  std::vector<double> all;
  for (std::size_t head = 0; head < num_heads; ++head) {
    for (const Forecasts& forecasts : set.forecasts) {
      for (const ClassProbabilities& one : forecasts.at.at(head)) {
        all.insert(all.end(), one.begin(), one.end());
      }
    }
  }
  return all;
}

ForecastSet read_forecast_set(Hdf5Reader& reader) {
  ForecastSet set;
  set.model = reader.text("model");
  const std::size_t size = formats::row_size(reader, "num_frames");
  const auto extents = reader.extents("probabilities");
  const std::size_t frames = !reader.problem() && extents.size() == 3 ? extents[1] : 0;
  const auto parts = formats::read_parts(reader, "num_frames", size, 1, frames);
  set.names = formats::read_lines(reader, "names", size);
  std::set<std::string_view> once;
  for (const std::string& name : set.names) {
    if (!once.insert(name).second) {
      reader.reject("data set names", "each once", fmt::format("{} twice", name));
    }
  }
  const std::vector<std::size_t> wanted{num_heads, frames, num_vehicle_classes};
  reader.want_numbers<double>("probabilities", wanted);
  std::vector<double> all(reader.problem() ? 0 : num_heads * frames * num_vehicle_classes);
  reader.numbers<double>("probabilities", wanted, {all.data()});
  set.forecasts.resize(reader.problem() ? 0 : size);
  auto from = all.begin();
  for (std::size_t head = 0; head < num_heads && !reader.problem(); ++head) {
    for (std::size_t i = 0; i < size; ++i) {
      auto& of_head = set.forecasts[i].at.at(head);
      of_head.resize(parts[i]);
      for (ClassProbabilities& one : of_head) {
        std::copy_n(from, num_vehicle_classes, one.begin());
        from += static_cast<std::ptrdiff_t>(num_vehicle_classes);
        if (!is_distribution(one)) {
          reader.reject("data set probabilities", "numbers in [0, 1] that sum to 1",
                        fmt::format("others in {}", set.names[i]));
        }
      }
    }
  }
  return set;
}

}  // namespace

std::optional<Error> write_forecasts(const fs::path& path, const ForecastSet& set) {
  expects(!set.forecasts.empty(), "forecasts of at least one sequence");
  expects(set.names.size() == set.forecasts.size(), "a name for each sequence");
  std::vector<double> num_frames;
  double frames = 0.0;
  for (const Forecasts& forecasts : set.forecasts) {
    for (const auto& of_head : forecasts.at) {
      expects(!of_head.empty() && of_head.size() == forecasts.at.front().size(),
              "as many frames for each head");
      expects(std::all_of(of_head.begin(), of_head.end(), is_distribution),
              "probabilities in [0, 1] that sum to 1");
    }
    num_frames.push_back(static_cast<double>(forecasts.at.front().size()));
    frames += num_frames.back();
  }
  Hdf5Writer writer;
  writer.text("model", set.model);
  formats::write_lines(writer, "names", set.names);
  formats::write_row(writer, "num_frames", num_frames);
  const std::vector<double> all = probabilities_of(set);
  writer.numbers<double>("probabilities",
                         {num_heads, static_cast<std::size_t>(frames), num_vehicle_classes},
                         {all.data()});
  return formats::write_sealed_hdf5(path, forecasts_format, writer);
}

Result<ForecastSet> read_forecasts(const fs::path& path) {
  return formats::read_sealed_hdf5(path, forecasts_format, read_forecast_set);
}

Result<std::vector<Forecasts>> forecasts_of(const ForecastSet& set,
                                            std::span<const Sequence> sequences,
                                            const std::string& source) {
  expects(set.names.size() == set.forecasts.size(), "a name for each sequence");
  std::map<std::string_view, const Forecasts*> by_name;
  for (std::size_t i = 0; i < set.names.size(); ++i) {
    by_name[set.names[i]] = &set.forecasts[i];
  }
  std::vector<Forecasts> found;
  for (const Sequence& sequence : sequences) {
    const auto one = by_name.find(sequence.name);
    if (one == by_name.end()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: want forecasts of {}, got none", source, sequence.name)};
    }
    const std::size_t frames = one->second->at.front().size();
    if (frames != sequence.observations.size()) {
      return Error{Error::Code::malformed,
                   fmt::format("{}: {}: want {} frames, got {}", source, sequence.name,
                               sequence.observations.size(), frames)};
    }
    found.push_back(*one->second);
  }
  return found;
}

}  // namespace saca::intention_scoring
