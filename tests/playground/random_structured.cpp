// Writes random structured programs to standard output, each ended by a byte 0. usage:
// random_structured FIRST_SEED COUNT

#include "tests/unit/structured/random_structured.h"

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3)
    return 2;
  const auto first = std::strtoull(argv[1], nullptr, 10);
  const auto count = std::strtoull(argv[2], nullptr, 10);
  for (auto seed = first; seed < first + count; ++seed)
    std::cout << orb::testing::RandomStructured(seed).write() << '\0';
}
