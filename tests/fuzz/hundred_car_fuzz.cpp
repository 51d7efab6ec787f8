#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>

#include "saca/lab/importers/hundred_car.h"
#include "saca/lab/recordings/hundred_car_file.h"

// Whatever a file of the 100-Car study holds, as its series or as its table of events: it is
// refused with a message that names it, or read. What is read is rebuilt to a scenario that a file
// may hold, or refused with a reason.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace recordings = saca::recordings;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  constexpr std::int64_t event = 8911;
  const auto rows = recordings::read_hundred_car_rows(text, "fuzz.txt", event);
  if (!rows.has_value() && rows.error().message.rfind("fuzz.txt", 0) != 0) {
    __builtin_trap();
  }
  if (rows.has_value()) {
    recordings::HundredCarEvent said{.nature = "Rear-end, striking"};
    said.start_sync =
        rows.value().front().sync + static_cast<std::int64_t>(rows.value().size() / 2);
    said.end_sync = said.start_sync + static_cast<std::int64_t>(size % 100);
    const auto made = saca::importers::judged_hundred_car(rows.value(), said, {.event = event});
    if (const auto* refusal = std::get_if<saca::importers::HundredCarRefusal>(&made)) {
      if (refusal->message.empty()) {
        __builtin_trap();
      }
    } else {
      const auto& scenario = std::get<saca::importers::HundredCarImport>(made).scenario;
      if (!saca::scenario::read_scenario(saca::scenario::write_scenario(scenario), "made")
               .has_value()) {
        __builtin_trap();
      }
    }
  }
  const auto told = recordings::read_hundred_car_event(text, "fuzz.txt", event);
  if (!told.has_value() && told.error().message.rfind("fuzz.txt", 0) != 0) {
    __builtin_trap();
  }
  return 0;
}
