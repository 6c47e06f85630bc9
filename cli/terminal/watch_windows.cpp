#include "cli/terminal/watch.h"

namespace orb::cli {

void watch(Context& context, const std::function<std::vector<std::string>()>&,
           const std::function<void()>&, const std::function<void()>&) {
  fail(context,
       {ExitCode::Usage, "`--watch` is not there on Windows; run the command again after a "
                         "change"});
}

} // namespace orb::cli
