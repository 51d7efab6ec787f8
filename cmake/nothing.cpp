// A library needs a source: this is the one of those that are taken from another build folder.
