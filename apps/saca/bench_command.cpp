#include "apps/saca/commands.h"
namespace saca::app {
void add_bench(CLI::App&, int&) {}
}  // namespace saca::app
