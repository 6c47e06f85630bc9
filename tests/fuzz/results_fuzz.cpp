// Reads any text as the results of a shard: it is refused, or joined with itself and alone, and
// printed in every format. What is read from JSON must be written as the same bytes.

#include "base/bytes.h"
#include "testing/verdicts/merge.h"
#include "testing/verdicts/render.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orb;
  const auto text = as_text({data, size});
  const auto part = testing::read_results("fuzz.json", text);
  if (!part)
    return 0;
  testing::merge({*part, *part});
  const auto joined = testing::merge({*part});
  if (!joined)
    return 0;
  for (const auto name : testing::format_names())
    testing::render(*joined, testing::format_called(name), testing::Listing::All, {});
  const auto json = testing::render_json(*joined);
  const auto again = testing::read_results("again.json", json);
  if (!again || testing::render_json(again->results) != json)
    __builtin_trap();
  return 0;
}
