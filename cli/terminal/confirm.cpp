#include "cli/terminal/confirm.h"

#include "cli/context/console.h"
#include "cli/context/context.h"
#include "cli/terminal/interrupt.h"

#include <fmt/format.h>
#include <iostream>
#include <string>

namespace orb::cli {

tl::expected<void, Failure> await_enter(std::string_view remedy) {
  print_err("  press Enter to start: ");
  std::string line;
  const bool pressed = static_cast<bool>(std::getline(std::cin, line));
  if (!pressed || !is_terminal(Stream::In))
    print_err("\n"); // a terminal has echoed the Enter
  if (pressed)
    return {};
  if (InterruptGuard::asked() > 0)
    return tl::unexpected(Failure{ExitCode::Interrupted, "interrupted"});
  return tl::unexpected(Failure{ExitCode::Usage, fmt::format("standard input ended before Enter "
                                                             "was pressed; {}",
                                                             remedy)});
}

} // namespace orb::cli
