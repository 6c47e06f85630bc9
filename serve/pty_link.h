#pragma once

#include "base/io_error.h"
#include "serve/descriptor_link.h"

#include <asio/steady_timer.hpp>
#include <tl/expected.hpp>

namespace orb::serve {

/// The master of a raw pty, and a symlink to its slave. Must poll to notice that a client has
/// opened the slave.
class PtyLink final : public DescriptorLink {
public:
  explicit PtyLink(asio::io_context& io) : DescriptorLink(io), timer_(io) {}
  PtyLink(const PtyLink&) = delete;
  PtyLink& operator=(const PtyLink&) = delete;
  ~PtyLink() override;

  tl::expected<void, IoError> open();
  /// Makes `path` a symlink to the slave, for the life of this object. Never replaces anything but
  /// a link to a vanished pty.
  tl::expected<void, IoError> make_link(const std::string& path);

  std::string address() const override { return "pty " + (path_.empty() ? slave_ : path_); }
  void start(Door& door) override;
  void hang_up() override;
  bool can_hang_up() const override { return false; }
  ssize_t write(ByteView bytes) override;

private:
  bool has_visit();
  bool is_exclusive();
  void replace();

  std::string slave_;
  std::string path_; ///< of the symlink
  asio::steady_timer timer_;
  Door* door_ = nullptr;
};

} // namespace orb::serve
