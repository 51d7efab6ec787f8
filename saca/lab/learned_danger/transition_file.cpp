#include "saca/lab/learned_danger/transition_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "saca/base/formats/checksummed_hdf5.h"

namespace saca::learned_danger {
namespace {

constexpr std::string_view part_format = "saca.transitions/1";

/// An array of the file that is one of Transitions.
struct Column {
  const char* name;
  std::vector<float> Transitions::*rows;
  std::size_t width;
};
const Column columns[] = {{"observations", &Transitions::observations, num_features},
                          {"next_observations", &Transitions::next_observations, num_features},
                          {"actions", &Transitions::actions, 2},
                          {"h", &Transitions::h, 1},
                          {"next_h", &Transitions::next_h, 1},
                          {"terminals", &Transitions::settled, 1},
                          {"timeouts", &Transitions::cut_off, 1},
                          {"drives", &Transitions::drive, 1}};

std::vector<std::size_t> extents_of(std::size_t rows, std::size_t width) {
  return width == 1 ? std::vector{rows} : std::vector{rows, width};
}

std::string features_text() {
  std::string all;
  for (const std::string& name : feature_names()) {
    all += name + "\n";
  }
  return all;
}

/// What is worked out of the others for who expects it there.
std::vector<float> rewards(const Transitions& all) {
  std::vector<float> made(all.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    made[i] = -std::hypot(all.actions[2 * i], all.actions[2 * i + 1]);
  }
  return made;
}

std::vector<float> costs(const Transitions& all) {
  std::vector<float> made(all.size());
  std::transform(all.h.begin(), all.h.end(), made.begin(),
                 [](float h) { return h >= 0.0F ? 1.0F : 0.0F; });
  return made;
}

constexpr std::int32_t many = std::numeric_limits<std::int32_t>::max();

Part read(formats::Hdf5Reader& reader) {
  Part part;
  part.car = reader.text_attribute(".", "car");
  const std::string seed = reader.text_attribute(".", "seed");
  const char* const end = seed.data() + seed.size();
  if (!reader.problem() && std::from_chars(seed.data(), end, part.seed).ptr != end) {
    reader.reject("attribute seed", "a whole number", seed);
  }
  part.mixture.looks = reader.whole(".", "looks", 1, many);
  part.mixture.situations = reader.whole(".", "situations_per_drive", 1, many);
  part.mixture.near_share = reader.number(".", "near_share");
  for (std::size_t k = 0; k < num_behaviours; ++k) {
    const std::string name =
        "share_" + std::string(learned_danger::name(static_cast<Behaviour>(k)));
    part.mixture.behaviours[k] = reader.number(".", name.c_str());
  }
  Transitions& all = part.transitions;
  all.drives = static_cast<std::size_t>(reader.whole(".", "num_drives", 1, many));
  all.near = static_cast<std::size_t>(reader.whole(".", "near", 0, many));
  all.situations = static_cast<std::size_t>(reader.whole(".", "situations", 1, many));
  const std::string features = reader.text("features");
  if (!reader.problem() && features != features_text()) {
    reader.reject("features", "those of this version", "others");
  }
  const std::vector<std::size_t> rows = reader.extents("h");
  if (reader.problem()) {
    return part;
  }
  for (const Column& column : columns) {
    const auto extents = extents_of(rows.empty() ? 1 : rows[0], column.width);
    reader.want_numbers<float>(column.name, extents);
    if (reader.problem()) {
      return part;
    }
    std::vector<float>& numbers = all.*column.rows;
    numbers.resize(extents[0] * column.width);
    reader.numbers<float>(column.name, extents, {numbers.data()});
  }
  return part;
}

}  // namespace

std::optional<Error> write_part(const std::filesystem::path& path, const Part& part) {
  const Transitions& all = part.transitions;
  if (all.size() == 0) {
    return Error{Error::Code::out_of_range,
                 fmt::format("{}: want a transition in each part, got none of {} drives; more "
                             "drives in a part have some",
                             path.string(), all.drives)};
  }
  formats::Hdf5Writer writer;
  writer.attribute(".", "car", part.car);
  writer.attribute(".", "seed", std::to_string(part.seed));
  writer.attribute(".", "looks", part.mixture.looks);
  writer.attribute(".", "situations_per_drive", part.mixture.situations);
  writer.attribute(".", "near_share", part.mixture.near_share);
  for (std::size_t k = 0; k < num_behaviours; ++k) {
    const std::string name =
        "share_" + std::string(learned_danger::name(static_cast<Behaviour>(k)));
    writer.attribute(".", name.c_str(), part.mixture.behaviours[k]);
  }
  writer.attribute(".", "num_drives", static_cast<std::int32_t>(all.drives));
  writer.attribute(".", "near", static_cast<std::int32_t>(all.near));
  writer.attribute(".", "situations", static_cast<std::int32_t>(all.situations));
  writer.text("features", features_text());
  for (const Column& column : columns) {
    writer.numbers<float>(column.name, extents_of(all.size(), column.width),
                          {(all.*column.rows).data()});
  }
  writer.numbers<float>("rewards", {all.size()}, {rewards(all).data()});
  writer.numbers<float>("costs", {all.size()}, {costs(all).data()});
  return formats::write_sealed_hdf5(path, part_format, writer);
}

Result<Part> read_part(const std::filesystem::path& path) {
  return formats::read_sealed_hdf5(path, part_format, read);
}

Result<Part> read_part_of(const std::filesystem::path& path, const std::string& car) {
  auto part = read_part(path);
  if (part.has_value() && part.value().car != car) {
    return Error{Error::Code::malformed,
                 fmt::format("{}: car: want {} as in the other parts, got {}", path.string(), car,
                             part.value().car)};
  }
  return part;
}

Result<std::vector<std::filesystem::path>> part_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> parts;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() == ".h5") {
      parts.push_back(entry.path());
    }
  }
  std::sort(parts.begin(), parts.end());
  if (parts.empty()) {
    return Error{Error::Code::unreadable,
                 folder.string() +
                     ": want a folder with parts of a data set (*.h5), as `saca danger dataset` "
                     "makes them"};
  }
  return parts;
}

}  // namespace saca::learned_danger
