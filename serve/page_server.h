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

/// A page for the user's own browser: HTTP/1.1 on the loopback address, at a path that nobody
/// guesses. The page hears events (server-sent events of WHATWG HTML, §9.2) and posts what its user
/// does. Everything happens within poll(); it starts no thread.
class PageServer {
public:
  /// A post: the part of its path after the secret one, and its body of at most 1024 bytes.
  using OnPost = std::function<void(std::string_view path, std::string_view body)>;

  static tl::expected<std::unique_ptr<PageServer>, IoError> start(std::string page, OnPost on_post);
  ~PageServer();

  /// `http://127.0.0.1:PORT/SECRET/`.
  const std::string& url() const;
  /// Serves what has come, and does not wait. Fails where whoever hears the posts throws.
  tl::expected<void, Failure> poll();
  /// Tells every open page; a page that does not keep up is closed.
  void send(std::string_view event);
  std::size_t listeners() const;

private:
  struct State;
  explicit PageServer(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

} // namespace orb::serve
