#include "run/run.h"

#include "run/live.h"

namespace orb::run {

tl::expected<Ending, Failure> run(std::span<const Input> inputs, const Options& options,
                                  Listener& listener, report::Journey* journey) {
  const auto live = Live::start(inputs, options, listener, journey);
  if (!live)
    return tl::unexpected(live.error());
  while ((*live)->advance((*live)->time() + options.slice)) {
  }
  return (*live)->finish();
}

} // namespace orb::run
