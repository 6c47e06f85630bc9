#include "serve/open_pty.h"

namespace orb::serve {

tl::expected<std::unique_ptr<Link>, PtyError> open_pty_link(asio::io_context&, const std::string&) {
  return tl::unexpected(
      PtyError{{"Windows has no pty; serve the ball with `--tcp 127.0.0.1:4242`"}, true});
}

} // namespace orb::serve
