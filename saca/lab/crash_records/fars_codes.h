#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/scene.h"
#include "saca/lab/crash_records/fars.h"

namespace saca::config {
class Table;
}

namespace saca::crash_records {

/// Both ends of what a number may be.
struct Span {
  double min = 0.0;
  double max = 0.0;
};

/// What a vehicle did whose speed has to be assumed.
enum class SpeedRole : std::uint8_t { straight, oncoming, crossing, slower, changing_lane };
[[nodiscard]] std::string_view name(SpeedRole role);

/// What codes of FARS mean, and what is assumed by them: data/crash_records/fars_codes.toml.
class FarsCodes {
 public:
  /// @return  Error::Code::malformed or out_of_range, naming source, line, key, wanted and got
  [[nodiscard]] static Result<FarsCodes> read(std::string_view text, std::string_view source);
  [[nodiscard]] static Result<FarsCodes> load(const std::filesystem::path& file);

  /// In words; "not known" of no code, "code 77" of one that is in no table.
  /// @param column  name of the column
  [[nodiscard]] std::string meaning(std::string_view column, const Code& code) const;

  /// nullopt: not known, or no road user of which there is a body.
  [[nodiscard]] std::optional<world::ActorKind> kind_of_body(const Code& body) const;
  /// Friction coefficient of a surface [-]; nullopt: not known.
  [[nodiscard]] std::optional<Span> grip(const Code& surface) const;
  /// Share of the speed limit.
  [[nodiscard]] Span speed_over_limit(SpeedRole role) const;

 private:
  struct Body {
    int first = 0;
    int last = 0;
    std::optional<world::ActorKind> kind;
    std::string meaning;
  };

  // What is wrong is the document's to tell.
  void read_meanings(config::Table& root);  ///< and grips
  void read_bodies(config::Table& root);
  void read_speeds(config::Table& root);

  std::map<std::string, std::map<int, std::string>, std::less<>> meanings_;
  std::vector<Body> bodies_;
  std::map<int, Span> grips_;
  std::map<SpeedRole, Span> speeds_;
};

}  // namespace saca::crash_records
