#pragma once

namespace saca {

/// Where standard input, output or error is closed, the next file that is opened would take its
/// place, and be written to as if it were that one. Opens instead what can be neither read nor
/// written. To be called first in a program.
void occupy_standard_files();

}  // namespace saca
