#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/base/world/cue.h"

namespace saca::families {

/// What samples are for. Who tunes on what it is tested on fools itself.
enum class Split : std::uint8_t {
  tuning,       ///< training, searching, looking
  calibration,  ///< thresholds and temperatures, once what is calibrated stands
  test,         ///< figures that are quoted, and nothing else
};

[[nodiscard]] std::string_view name(Split split);
[[nodiscard]] std::optional<Split> split_from(std::string_view name);

/// The seeds of the splits, and the families that only the test split has.
struct Splits {
  std::array<std::uint64_t, 3> seeds{};  ///< by Split, all different
  std::vector<std::string> test_only;
};

/// @return  Error::Code::malformed or out_of_range, naming source, line, key, wanted and got
[[nodiscard]] Result<Splits> read_splits(std::string_view text, std::string_view source);
[[nodiscard]] Result<Splits> load_splits(const std::filesystem::path& path);

/// Where every use of the test split is noted, one line each, for good: "PURPOSE: family NAME".
struct TestLog {
  std::filesystem::path path;
  std::string purpose;  ///< who draws, and what for
};

/// The seed with which samples of a family are drawn for a split.
///
/// @param log  needed for the test split, which is noted there before the seed is given
/// @return     Error::Code::out_of_range: a test-only family outside the test split, or the test
///             split without a log; unwritable: the log; malformed, naming the line: a file that
///             is no such log, which stays as it was
[[nodiscard]] Result<std::uint64_t> seed_for(const Splits& splits, Split split,
                                             std::string_view family,
                                             const std::optional<TestLog>& log);

/// A mixture of families.
struct Suite {
  struct Member {
    std::string family;
    double weight = 0.0;  ///< > 0; of all weights
    std::string source;   ///< of the weight
  };
  std::string name;
  std::string why;
  std::vector<Member> members;            ///< at least one
  std::vector<world::CueKind> cues = {};  ///< that its encounters have; none: it has no cues
};

/// Reads the suites of a file, schema saca.suites/1.
/// @return  Error::Code::malformed or out_of_range, naming source, line, key, wanted and got
[[nodiscard]] Result<std::vector<Suite>> read_suites(std::string_view text,
                                                     std::string_view source);
[[nodiscard]] Result<std::vector<Suite>> load_suites(const std::filesystem::path& path);

/// Which member encounter `number` of the suite belongs to: as often as its weight says, spread
/// evenly (a golden-ratio sequence), the same for every split.
[[nodiscard]] std::size_t member_of(const Suite& suite, std::uint64_t number);

}  // namespace saca::families
