#include "serve/line_reader.h"

#include <algorithm>
#include <array>
#include <asio/post.hpp>
#include <cerrno>
#include <mutex>
#include <thread>
#include <utility>

namespace orb::serve {

struct LineReader::Shared {
  std::mutex mutex;
  asio::io_context* io = nullptr; ///< null: the reader is gone
  std::function<void(const std::string&)> on_line;

  /// Returns false if the reader is gone.
  static bool hand_on(const std::shared_ptr<Shared>& shared, std::string line) {
    const std::lock_guard lock(shared->mutex);
    if (shared->io == nullptr)
      return false;
    asio::post(*shared->io, [shared, line = std::move(line)] { shared->on_line(line); });
    return true;
  }
};

LineReader::LineReader(asio::io_context& io, Read read,
                       std::function<void(const std::string&)> on_line)
    : shared_(std::make_shared<Shared>()) {
  shared_->io = &io;
  shared_->on_line = std::move(on_line);
  std::thread([shared = shared_, read = std::move(read)] {
    std::string text;
    std::array<char, longest> piece{};
    for (bool goes_on = true; goes_on;) {
      const auto size = read(piece);
      if (size < 0 && errno == EINTR)
        continue;
      goes_on = size > 0;
      text.append(piece.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
      if (!goes_on && !text.empty())
        text += '\n';
      for (std::size_t end = text.find('\n'); end != std::string::npos || text.size() > longest;
           end = text.find('\n')) {
        auto line = text.substr(0, end == std::string::npos ? longest : end);
        text.erase(0, line.size() + (end == std::string::npos ? 0 : 1));
        if (line.ends_with('\r'))
          line.pop_back();
        goes_on = Shared::hand_on(shared, std::move(line)) && goes_on;
      }
    }
  }).detach();
}

LineReader::~LineReader() {
  const std::lock_guard lock(shared_->mutex);
  shared_->io = nullptr;
}

} // namespace orb::serve
