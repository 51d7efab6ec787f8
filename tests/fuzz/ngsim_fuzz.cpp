#include <cstddef>
#include <cstdint>
#include <string_view>

#include "saca/lab/recordings/ngsim_csv.h"
#include "saca/lab/recordings/ngsim_set.h"
#include "saca/lab/recordings/recorded_set.h"

namespace {

void require(bool promise) {
  if (!promise) {
    __builtin_trap();
  }
}

}  // namespace

// Whatever a trajectory file holds, in whatever pieces it comes: it is refused with a message that
// names it, or what is made of it breaks no rule of a set. A broken promise traps.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace recordings = saca::recordings;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  recordings::NgsimTable table;
  recordings::NgsimReader reader("fuzz.csv", table);
  constexpr std::size_t piece = 61;
  for (std::size_t from = 0; from < size; from += piece) {
    reader.take(text.substr(from, piece));
  }
  if (const auto problem = reader.finish()) {
    require(problem->message.rfind("fuzz.csv:", 0) == 0);
    return 0;
  }
  const recordings::RecordedSet set = recordings::set_of_ngsim(table, "fuzz");
  require(set.recordings.empty() || !recordings::broken_rule(set));
  return 0;
}
