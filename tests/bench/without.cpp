// Compiles a structured program without one pass of the optimiser and prints its image;
// tests/bench/examples compares the results. The compiler has no switch for this: the linker wraps
// the calls of a pass (CMakeLists.txt reads the symbols below), which requires that its files are
// compiled one by one.
//   orb_without PASS FILE   omits the pass; an unknown name omits none
//   orb_without             prints the names of the passes

#include "structured/compile.h"
#include "structured/optimise/arms.h"
#include "structured/optimise/counted.h"
#include "structured/optimise/elements.h"
#include "structured/optimise/forward.h"
#include "structured/optimise/inline.h"
#include "structured/optimise/jumps.h"
#include "structured/optimise/repeated.h"
#include "structured/optimise/split.h"
#include "structured/optimise/tails.h"
#include "structured/optimise/thread.h"
#include "structured/optimise/webs.h"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <string>

namespace orb::structured {
namespace {

std::string_view left_out;
std::string names;

struct Name {
  explicit Name(const char* name) { names += fmt::format("{}\n", name); }
};

} // namespace

#define PASS(Result, name, parameters, arguments, symbol)                                          \
  const Name named_##name{#name};                                                                  \
  Result real_##name parameters asm("__real_" symbol);                                             \
  Result wrapped_##name parameters asm("__wrap_" symbol);                                          \
  Result wrapped_##name parameters {                                                               \
    return left_out == #name ? Result() : real_##name arguments;                                   \
  }

// clang-format off
PASS(bool, split_variables, (Code& code), (code), "_ZN3orb10structured15split_variablesERNS0_4CodeE")
PASS(bool, forward_values, (Code& code), (code), "_ZN3orb10structured14forward_valuesERNS0_4CodeE")
PASS(bool, drop_repeated, (Code& code), (code), "_ZN3orb10structured13drop_repeatedERNS0_4CodeE")
PASS(bool, merge_tails, (Code& code), (code), "_ZN3orb10structured11merge_tailsERNS0_4CodeE")
PASS(bool, inline_calls, (Code& code), (code), "_ZN3orb10structured12inline_callsERNS0_4CodeE")
PASS(bool, straighten, (Code& code), (code), "_ZN3orb10structured10straightenERNS0_4CodeE")
PASS(bool, use_elements, (Code& code), (code), "_ZN3orb10structured12use_elementsERNS0_4CodeE")
PASS(bool, compute_arms, (Code& code), (code), "_ZN3orb10structured12compute_armsERNS0_4CodeE")
PASS(bool, thread_tests, (Code& code, Ranges& ranges, std::vector<AddedLine>& added), (code, ranges, added),
     "_ZN3orb10structured12thread_testsERNS0_4CodeERNS0_6RangesERSt6vectorISt4pairIjNS0_8CodeLineEESaIS8_EE")
PASS(bool, split_ways, (Code& code, Ranges& ranges), (code, ranges), "_ZN3orb10structured10split_waysERNS0_4CodeERNS0_6RangesE")
PASS(void, count_loops, (Code& code, const Identity& identity), (code, identity),
     "_ZN3orb10structured11count_loopsERNS0_4CodeERKSt8functionIFjjEE")
// clang-format on

} // namespace orb::structured

int main(int count, char** words) {
  using namespace orb::structured;
  if (count != 3) {
    std::fputs(names.c_str(), stdout);
    return 0;
  }
  left_out = words[1];
  std::ifstream file(words[2], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  NoFiles files;
  const auto compiled = compile(words[2], words[2], text, {}, files);
  std::fwrite(compiled.image.bytes.data(), 1, compiled.image.bytes.size(), stdout);
  return compiled.has_errors() ? 1 : 0;
}
