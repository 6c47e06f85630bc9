#pragma once

#include "base/exit_code.h"
#include "base/io_error.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace orb::serve {

/// Serves a page to the user's own browser: HTTP/1.1 on the loopback address, at an unguessable
/// path. The page receives events (server-sent events of WHATWG HTML, §9.2) and posts what its user
/// does. All work happens in poll(); there is no thread.
class PageServer {
public:
  /// Handles a post: the path after the secret part, and a body of at most 1024 bytes.
  using OnPost = std::function<void(std::string_view path, std::string_view body)>;

  static tl::expected<std::unique_ptr<PageServer>, IoError> start(std::string page, OnPost on_post);
  ~PageServer();

  /// `http://127.0.0.1:PORT/SECRET/`.
  const std::string& url() const;
  /// Handles pending work without waiting. Fails if the post handler throws.
  tl::expected<void, Failure> poll();
  /// Sends an event to every open page. Closes a page that does not keep up.
  void send(std::string_view event);
  std::size_t listeners() const;

private:
  struct Impl;
  explicit PageServer(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

} // namespace orb::serve
