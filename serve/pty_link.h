#pragma once

#include "base/files.h"
#include "serve/link.h"

#include <asio/steady_timer.hpp>
#include <tl/expected.hpp>

namespace orb::serve {

/// The master of a raw pty, and the symlink to its slave. It has to be asked whether a client has
/// opened the slave.
class PtyLink final : public Link {
public:
  explicit PtyLink(asio::io_context& io) : Link(io), timer_(io) {}
  PtyLink(const PtyLink&) = delete;
  PtyLink& operator=(const PtyLink&) = delete;
  ~PtyLink() override;

  /// Opens the pty and makes `link` a symlink to it; empty for none.
  tl::expected<void, IoError> open(const std::string& link);

  std::string address() const override { return "pty " + (link_.empty() ? slave_ : link_); }
  void start(Door& door) override;
  void hang_up() override;
  bool can_hang_up() const override { return false; }

private:
  void make_raw() const;

  std::string slave_;
  std::string link_;
  asio::steady_timer timer_;
  Door* door_ = nullptr;
};

} // namespace orb::serve
