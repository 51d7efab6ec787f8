#pragma once

namespace saca::network_training {

/// Lets each thread of a program multiply matrices by itself: OpenBLAS would else spread each
/// product over threads of its own. It reads that once, when it is loaded, so the program begins
/// anew with it. To be called first in main.
///
/// OpenBLAS must be the build with threads (libopenblas0-pthread): products of the serial build are
/// wrong now and then when two threads ask at once, and nothing says so.
void give_each_thread_its_own_products(char** argv);

}  // namespace saca::network_training
