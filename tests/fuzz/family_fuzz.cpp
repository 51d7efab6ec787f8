#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "saca/base/core/file.h"
#include "saca/lab/families/family.h"
#include "saca/lab/families/splits.h"

namespace {

/// A message names the file that is wrong.
template <class T>
void expect_named(const saca::Result<T>& result) {
  if (!result.has_value() && result.error().message.rfind("fuzz.toml", 0) != 0 &&
      result.error().message.rfind("surroundings", 0) != 0) {
    __builtin_trap();
  }
}

}  // namespace

// Whatever a family, its surroundings, splits or suites hold: it is refused with a message that
// names the file, or every range in it is one.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace families = saca::families;
  static const std::string surroundings =
      saca::read_file(SACA_FAMILIES "/surroundings.toml").value();
  static const std::string crossing = saca::read_file(SACA_FAMILIES "/crossing.toml").value();
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto family = families::read_family(text, "fuzz.toml", surroundings, "surroundings");
  expect_named(family);
  if (family.has_value()) {
    for (const auto& [key, range] : family.value().ranges) {
      if (!(range.min <= range.max) || range.source.empty()) {
        __builtin_trap();
      }
    }
  }
  expect_named(families::read_family(crossing, "crossing", text, "fuzz.toml"));
  expect_named(families::read_splits(text, "fuzz.toml"));
  expect_named(families::read_suites(text, "fuzz.toml"));
  return 0;
}
