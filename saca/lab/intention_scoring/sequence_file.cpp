#include "saca/lab/intention_scoring/sequence_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
using intent::Observation;

constexpr std::string_view sequences_format = "saca.sequences/1";

struct Column {
  const char* name;
  double Observation::*value;
};

constexpr std::array<Column, 12> columns{{
    {"frames/speed_mps", &Observation::speed},
    {"frames/acceleration_mps2", &Observation::acceleration},
    {"frames/yaw_rate_radps", &Observation::yaw_rate},
    {"frames/offset_m", &Observation::offset},
    {"frames/lateral_speed_mps", &Observation::lateral_speed},
    {"frames/heading_rad", &Observation::heading},
    {"frames/lane_width_m", &Observation::lane_width},
    {"frames/gap_m", &Observation::gap},
    {"frames/gap_speed_mps", &Observation::gap_speed},
    {"frames/steering_rad", &Observation::steering},
    {"frames/throttle", &Observation::throttle},
    {"frames/brake", &Observation::brake},
}};

bool is_word(const std::string& text) {
  return !text.empty() && text.find_first_of("\r\n") == std::string::npos &&
         text.find('\0') == std::string::npos;
}

bool increase(const std::vector<double>& times) {
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || times[i] < 0.0 || (i > 0 && times[i] <= times[i - 1])) {
      return false;
    }
  }
  return true;
}

/// NaN is "not known"; only a gap may be infinite.
bool is_observation(const Observation& seen) {
  const bool moves = std::isfinite(seen.speed) && seen.speed >= 0.0;
  const bool some = std::any_of(columns.begin(), columns.end(), [&](const Column& column) {
    return std::isinf(seen.*column.value) && column.value != &Observation::gap;
  });
  return moves && !some && !(seen.gap == -std::numeric_limits<double>::infinity());
}

std::optional<std::string> broken_rule_of(const Sequence& sequence) {
  const std::size_t frames = sequence.observations.size();
  if (!is_word(sequence.name) || !is_word(sequence.site) || !is_word(sequence.group)) {
    return "names, sites and groups are one line each";
  }
  if (frames == 0 || sequence.labels.size() != frames || sequence.scored.size() != frames) {
    return fmt::format("{}: a label, and whether it is scored, for each frame", sequence.name);
  }
  if (std::any_of(sequence.labels.begin(), sequence.labels.end(),
                  [](std::uint8_t label) { return label >= num_vehicle_classes; })) {
    return fmt::format("{}: labels are 0 to 5", sequence.name);
  }
  if (!std::all_of(sequence.observations.begin(), sequence.observations.end(), is_observation)) {
    return fmt::format("{}: speeds are >= 0, and only a gap is infinite", sequence.name);
  }
  if (!increase(sequence.crossing_times) || !increase(sequence.braking_times)) {
    return fmt::format("{}: times are >= 0 and increase", sequence.name);
  }
  return std::nullopt;
}

// --- writing
// --------------------------------------------------------------------------------------

template <class Of>
std::vector<double> each(std::span<const Sequence> sequences, const Of& of) {
  std::vector<double> row;
  for (const Sequence& sequence : sequences) {
    row.push_back(static_cast<double>(of(sequence)));
  }
  return row;
}

template <class Of>
std::vector<double> each_frame(std::span<const Sequence> sequences, const Of& of) {
  std::vector<double> row;
  for (const Sequence& sequence : sequences) {
    for (std::size_t t = 0; t < sequence.observations.size(); ++t) {
      row.push_back(of(sequence, t));
    }
  }
  return row;
}

void write_words(Hdf5Writer& writer, const char* name, const SequenceSet& set,
                 std::string Sequence::*word) {
  std::vector<std::string> lines;
  for (const Sequence& sequence : set.sequences) {
    lines.push_back(sequence.*word);
  }
  formats::write_lines(writer, name, lines);
}

/// All sequences' times one after another; a file without any has no such row.
void write_times(Hdf5Writer& writer, const char* counts, const char* name, const SequenceSet& set,
                 std::vector<double> Sequence::*times) {
  formats::write_row(writer, counts,
                     each(set.sequences, [&](const Sequence& s) { return (s.*times).size(); }));
  std::vector<double> row;
  for (const Sequence& sequence : set.sequences) {
    row.insert(row.end(), (sequence.*times).begin(), (sequence.*times).end());
  }
  if (!row.empty()) {
    formats::write_row(writer, name, row);
  }
}

// --- reading
// --------------------------------------------------------------------------------------

void read_times(Hdf5Reader& reader, const char* counts, const char* name, SequenceSet& set,
                std::vector<double> Sequence::*times) {
  const std::size_t size = reader.has(name) ? formats::row_size(reader, name) : 0;
  const auto parts = formats::read_parts(reader, counts, set.sequences.size(), 0, size);
  const std::vector<double> row =
      size > 0 ? formats::read_row(reader, name, size) : std::vector<double>();
  auto from = row.begin();
  for (std::size_t i = 0; i < set.sequences.size() && !reader.problem(); ++i) {
    const auto to = from + static_cast<std::ptrdiff_t>(parts[i]);
    (set.sequences[i].*times).assign(from, to);
    from = to;
  }
}

void read_words(Hdf5Reader& reader, const char* name, SequenceSet& set,
                std::string Sequence::*word) {
  const auto lines = formats::read_lines(reader, name, set.sequences.size());
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    set.sequences[i].*word = lines[i];
  }
}

void read_frames(Hdf5Reader& reader, SequenceSet& set) {
  const std::size_t size = formats::row_size(reader, "frames/label");
  const auto parts =
      formats::read_parts(reader, "sequences/num_frames", set.sequences.size(), 1, size);
  const auto labels = formats::read_counts(reader, "frames/label", size, 0);
  const auto scored = formats::read_flags(reader, "frames/scored", size);
  std::vector<Observation> seen(reader.problem() ? 0 : size);
  for (const Column& column : columns) {
    const auto row = formats::read_row(reader, column.name, seen.size(), formats::Numbers::all);
    for (std::size_t t = 0; t < seen.size(); ++t) {
      seen[t].*column.value = row[t];
    }
  }
  std::size_t from = 0;
  for (std::size_t i = 0; i < set.sequences.size() && !reader.problem(); ++i) {
    Sequence& sequence = set.sequences[i];
    for (std::size_t t = from; t < from + parts[i]; ++t) {
      sequence.observations.push_back(seen[t]);
      sequence.labels.push_back(static_cast<std::uint8_t>(
          std::min<std::size_t>(labels[t], std::numeric_limits<std::uint8_t>::max())));
      sequence.scored.push_back(scored[t]);
    }
    from += parts[i];
  }
}

SequenceSet read_set(Hdf5Reader& reader) {
  SequenceSet set;
  const std::size_t size = formats::row_size(reader, "sequences/simulated");
  const auto simulated = formats::read_flags(reader, "sequences/simulated", size);
  set.sequences.resize(reader.problem() ? 0 : size);
  for (std::size_t i = 0; i < set.sequences.size(); ++i) {
    set.sequences[i].simulated = simulated[i];
  }
  read_words(reader, "sequences/names", set, &Sequence::name);
  read_words(reader, "sequences/sites", set, &Sequence::site);
  read_words(reader, "sequences/groups", set, &Sequence::group);
  set.splits = formats::read_lines(reader, "sequences/splits", set.sequences.size());
  read_frames(reader, set);
  read_times(reader, "sequences/num_crossings", "crossing_times_s", set, &Sequence::crossing_times);
  read_times(reader, "sequences/num_brakings", "braking_times_s", set, &Sequence::braking_times);
  if (const auto broken = broken_rule(set); broken && !reader.problem()) {
    reader.reject("contents", *broken);
  }
  return set;
}

}  // namespace

std::optional<std::string> broken_rule(const SequenceSet& set) {
  if (set.splits.size() != set.sequences.size()) {
    return "a split for each sequence";
  }
  std::set<std::string> names;
  for (const Sequence& sequence : set.sequences) {
    if (auto broken = broken_rule_of(sequence)) {
      return broken;
    }
    if (!names.insert(sequence.name).second) {
      return fmt::format("names are unique, {} is not", sequence.name);
    }
  }
  if (!std::all_of(set.splits.begin(), set.splits.end(), is_word)) {
    return "splits are one line each";
  }
  return std::nullopt;
}

std::optional<Error> write_sequences(const fs::path& path, const SequenceSet& set) {
  expects(!set.sequences.empty(), "at least one sequence");
  expects(!broken_rule(set), "the set breaks no rule");
  const std::span<const Sequence> all = set.sequences;
  Hdf5Writer writer;
  writer.attribute(".", "step_s", frame_step);
  writer.group("sequences");
  write_words(writer, "sequences/names", set, &Sequence::name);
  write_words(writer, "sequences/sites", set, &Sequence::site);
  write_words(writer, "sequences/groups", set, &Sequence::group);
  formats::write_lines(writer, "sequences/splits", set.splits);
  formats::write_row(writer, "sequences/simulated",
                     each(all, [](const Sequence& s) { return s.simulated ? 1 : 0; }));
  formats::write_row(writer, "sequences/num_frames",
                     each(all, [](const Sequence& s) { return s.labels.size(); }));
  writer.group("frames");
  for (const Column& column : columns) {
    formats::write_row(writer, column.name, each_frame(all, [&](const Sequence& s, std::size_t t) {
                         return s.observations[t].*column.value;
                       }));
  }
  formats::write_row(writer, "frames/label", each_frame(all, [](const Sequence& s, std::size_t t) {
                       return static_cast<double>(s.labels[t]);
                     }));
  formats::write_row(writer, "frames/scored", each_frame(all, [](const Sequence& s, std::size_t t) {
                       return s.scored[t] ? 1.0 : 0.0;
                     }));
  write_times(writer, "sequences/num_crossings", "crossing_times_s", set,
              &Sequence::crossing_times);
  write_times(writer, "sequences/num_brakings", "braking_times_s", set, &Sequence::braking_times);
  return formats::write_sealed_hdf5(path, sequences_format, writer);
}

Result<SequenceSet> read_sequences(const fs::path& path) {
  return formats::read_sealed_hdf5(path, sequences_format, read_set);
}

}  // namespace saca::intention_scoring
