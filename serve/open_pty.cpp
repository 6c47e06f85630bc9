#include "serve/open_pty.h"

#include "serve/pty_link.h"

namespace orb::serve {

tl::expected<std::unique_ptr<Link>, PtyError> open_pty_link(asio::io_context& io,
                                                            const std::string& path) {
  auto pty = std::make_unique<PtyLink>(io);
  if (const auto opened = pty->open(); !opened)
    return tl::unexpected(PtyError{opened.error(), true});
  if (!path.empty())
    if (const auto linked = pty->make_link(path); !linked)
      return tl::unexpected(PtyError{linked.error(), false});
  return pty;
}

} // namespace orb::serve
