#include "saca/lab/reach_study/spare_memory.h"

#include <fstream>
#include <string>

namespace saca::reach_study {

std::optional<double> available_memory(std::istream& meminfo) {
  std::string key;
  for (double kib = 0.0; meminfo >> key >> kib; meminfo.ignore(80, '\n')) {
    if (key == "MemAvailable:") {
      return kib / 1024.0;
    }
  }
  return std::nullopt;
}

std::optional<double> spare_memory() {
  std::ifstream file("/proc/meminfo");
  return available_memory(file);
}

}  // namespace saca::reach_study
