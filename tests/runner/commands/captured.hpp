// What is printed while something runs.
#pragma once

#include <iostream>
#include <sstream>
#include <string>

namespace grainsweep {

struct Printed {
  std::string out, error;
};

/// Calls print() and returns what it put on standard output and standard error of the process.
template <class Print>
Printed printed_by(const Print& print) {
  std::ostringstream out, error;
  std::streambuf* const old_out = std::cout.rdbuf(out.rdbuf());
  std::streambuf* const old_error = std::cerr.rdbuf(error.rdbuf());
  print();
  std::cout.rdbuf(old_out);
  std::cerr.rdbuf(old_error);
  return {out.str(), error.str()};
}

}  // namespace grainsweep
