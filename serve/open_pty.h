#pragma once

#include "base/io_error.h"
#include "serve/link.h"

#include <asio/io_context.hpp>
#include <memory>
#include <tl/expected.hpp>

namespace orb::serve {

struct PtyError {
  IoError error;
  bool has_no_pty = false; ///< the system provides none; otherwise the symlink could not be made
};

/// Opens a pty and makes a symlink `path` to it, unless that is empty.
tl::expected<std::unique_ptr<Link>, PtyError> open_pty_link(asio::io_context& io,
                                                            const std::string& path);

} // namespace orb::serve
