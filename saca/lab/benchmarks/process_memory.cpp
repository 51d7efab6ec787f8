#include "saca/lab/benchmarks/process_memory.h"

#include <fstream>

namespace saca::benchmarks {

double status_memory(std::istream& status, const std::string& name) {
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(name + ":", 0) == 0) {
      return std::stod(line.substr(name.size() + 1)) / 1024.0;
    }
  }
  return 0.0;
}

double process_memory(const std::string& name) {
  std::ifstream file("/proc/self/status");
  return status_memory(file, name);
}

void forget_memory_peak() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace saca::benchmarks
