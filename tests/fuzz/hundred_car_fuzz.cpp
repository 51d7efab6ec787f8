#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/traffic/hundred_car_file.h"

// Whatever a file of the 100-Car study holds, as its series or as its table of events: it is
// refused with a message that names it, or read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace traffic = saca::traffic;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  constexpr std::int64_t event = 8911;
  const auto rows = traffic::read_hundred_car_rows(text, "fuzz.txt", event);
  if (!rows.has_value() && rows.error().message.rfind("fuzz.txt", 0) != 0) {
    __builtin_trap();
  }
  const auto told = traffic::read_hundred_car_event(text, "fuzz.txt", event);
  if (!told.has_value() && told.error().message.rfind("fuzz.txt", 0) != 0) {
    __builtin_trap();
  }
  return 0;
}
