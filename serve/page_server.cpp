#include "serve/page_server.h"

#include "base/contain.h"
#include "base/text/header_fields.h"

#include <algorithm>
#include <asio.hpp>
#include <deque>
#include <fmt/format.h>
#include <list>
#include <optional>
#include <random>
#include <utility>

// A minimal HTTP server: Debian's HTTP libraries load TLS at every program start, and a page on the
// same computer needs very little of HTTP.

namespace orb::serve {
namespace {

using asio::ip::tcp;

constexpr std::size_t most_head = 8192;  // bytes: ten times what browsers send
constexpr std::size_t most_body = 1024;  // bytes: a post holds a few numbers
constexpr std::size_t most_waiting = 64; ///< events that a page has not yet received
constexpr std::size_t most_guests = 16;

/// Returns 128 random bits as hex digits.
std::string make_secret() {
  std::random_device draw;
  std::string text;
  for (int i = 0; i < 4; ++i)
    text += fmt::format("{:08x}", draw());
  return text;
}

std::string answer(std::string_view status, std::string_view type, std::string_view body) {
  return fmt::format("HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n"
                     "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
                     "Content-Security-Policy: default-src 'none'; style-src 'unsafe-inline'; "
                     "script-src 'unsafe-inline'; connect-src 'self'; img-src data:; "
                     "frame-ancestors 'none'\r\nConnection: close\r\n\r\n{}",
                     status, type, body.size(), body);
}

constexpr std::string_view nothing_here = "there is nothing here\n";
constexpr std::string_view event_head = "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n"
                                        "Cache-Control: no-store\r\nConnection: close\r\n\r\n";

/// The first line of a request.
struct Request {
  std::string_view method;
  std::string_view path;
};

/// Returns nullopt if the line is not a request.
std::optional<Request> read_request(std::string_view line) {
  const auto blank = line.find(' ');
  const auto end = line.rfind(' ');
  if (blank == std::string_view::npos || end <= blank)
    return std::nullopt;
  return Request{line.substr(0, blank), line.substr(blank + 1, end - blank - 1)};
}

/// A connection: an incoming request, or a page that receives events.
struct Guest {
  explicit Guest(tcp::socket from) : socket(std::move(from)) {}
  tcp::socket socket;
  std::string in;
  std::deque<std::string> out;
  bool listens = false;
  bool leaves = false; ///< close after all output is sent
  bool gone = false;
};

} // namespace

struct PageServer::Impl {
  Impl(std::string text, OnPost hears) : page(std::move(text)), on_post(std::move(hears)) {}

  tl::expected<void, IoError> open();
  void poll();
  void accept();
  bool make_room();
  void read(Guest& guest);
  void write(Guest& guest);
  void say(Guest& guest, std::string text);
  void serve(Guest& guest);
  void answer_to(Guest& guest, const Request& request, std::string_view body);
  void refuse(Guest& guest, std::string_view status, std::string_view why);

  std::string page;
  OnPost on_post;
  asio::io_context context;
  tcp::acceptor acceptor{context};
  std::string base; ///< `/SECRET/`
  std::string url;
  std::list<Guest> guests;
};

tl::expected<void, IoError> PageServer::Impl::open() {
  asio::error_code error;
  const tcp::endpoint place(asio::ip::address_v4::loopback(), 0);
  acceptor.open(place.protocol(), error);
  if (!error)
    acceptor.bind(place, error);
  if (!error)
    acceptor.listen(static_cast<int>(most_guests), error);
  if (error)
    return tl::unexpected(IoError{fmt::format("cannot serve a page: {}", error.message())});
  base = "/" + make_secret() + "/";
  url = fmt::format("http://127.0.0.1:{}{}", acceptor.local_endpoint().port(), base);
  accept();
  return {};
}

void PageServer::Impl::accept() {
  acceptor.async_accept([this](asio::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted)
      return;
    if (!error && make_room())
      read(guests.emplace_back(std::move(socket)));
    accept();
  });
}

/// Drops an idle connection if all slots are taken, so that the page can always get through.
bool PageServer::Impl::make_room() {
  if (guests.size() < most_guests)
    return true;
  const auto idle = std::find_if(guests.begin(), guests.end(),
                                 [](const Guest& guest) { return !guest.listens && !guest.gone; });
  if (idle == guests.end())
    return false;
  idle->gone = true;
  return true;
}

void PageServer::Impl::read(Guest& guest) {
  const auto before = guest.in.size();
  constexpr std::size_t piece = 2048; // bytes per read
  guest.in.resize(before + piece);
  guest.socket.async_read_some(asio::buffer(guest.in.data() + before, piece),
                               [this, &guest, before](asio::error_code error, std::size_t n) {
                                 guest.in.resize(before + n);
                                 if (error) {
                                   guest.gone = true;
                                   return;
                                 }
                                 serve(guest);
                                 if (!guest.leaves && !guest.gone)
                                   read(guest);
                               });
}

/// Answers a complete request. Rejects a wrong secret path as soon as it is seen.
void PageServer::Impl::serve(Guest& guest) {
  if (guest.listens) {
    guest.in.clear(); // ignore input of a page that receives events
    return;
  }
  constexpr std::string_view blank_line = "\r\n\r\n";
  const auto text = std::string_view(guest.in);
  const auto end = text.find(blank_line);
  if (end == std::string_view::npos) {
    if (text.size() > most_head)
      guest.gone = true;
    return;
  }
  const auto head = text.substr(0, end);
  const auto line = head.substr(0, head.find("\r\n"));
  auto request = read_request(line);
  if (!request)
    return refuse(guest, "400 Bad Request", "this request is not supported\n");
  if (!request->path.starts_with(base))
    return refuse(guest, "404 Not Found", nothing_here);
  const auto length = body_length(head.substr(line.size()));
  if (length.said == BodyLength::Found::Nonsense || length.bytes > most_body)
    return refuse(guest, "400 Bad Request", "this request is not supported\n");
  const auto body = text.substr(end + blank_line.size());
  request->path.remove_prefix(base.size());
  if (body.size() >= length.bytes)
    answer_to(guest, *request, body.substr(0, length.bytes));
}

/// `request.path` lacks the secret part.
void PageServer::Impl::answer_to(Guest& guest, const Request& request, std::string_view body) {
  if (request.method == "GET" && request.path == "events") {
    guest.listens = true;
    return say(guest, std::string(event_head));
  }
  if (request.method == "POST") {
    on_post(request.path, body);
    guest.leaves = true;
    return say(guest, answer("204 No Content", "text/plain", ""));
  }
  if (request.method != "GET" || !request.path.empty())
    return refuse(guest, "404 Not Found", nothing_here);
  guest.leaves = true;
  say(guest, answer("200 OK", "text/html; charset=utf-8", page));
}

void PageServer::Impl::refuse(Guest& guest, std::string_view status, std::string_view why) {
  guest.leaves = true;
  say(guest, answer(status, "text/plain", why));
}

void PageServer::Impl::say(Guest& guest, std::string text) {
  if (guest.out.size() >= most_waiting) {
    guest.gone = true;
    return;
  }
  guest.out.push_back(std::move(text));
  if (guest.out.size() == 1)
    write(guest);
}

void PageServer::Impl::write(Guest& guest) {
  asio::async_write(guest.socket, asio::buffer(guest.out.front()),
                    [this, &guest](asio::error_code error, std::size_t) {
                      guest.out.pop_front();
                      if (error)
                        guest.gone = true;
                      else if (!guest.out.empty())
                        write(guest);
                      else if (guest.leaves) {
                        asio::error_code ignored;
                        guest.socket.shutdown(tcp::socket::shutdown_send, ignored);
                        guest.gone = true;
                      }
                    });
}

PageServer::PageServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PageServer::~PageServer() = default;

tl::expected<std::unique_ptr<PageServer>, IoError> PageServer::start(std::string page,
                                                                     OnPost on_post) {
  auto impl = std::make_unique<Impl>(std::move(page), std::move(on_post));
  if (auto opened = impl->open(); !opened)
    return tl::unexpected(opened.error());
  return std::unique_ptr<PageServer>(new PageServer(std::move(impl)));
}

const std::string& PageServer::url() const {
  return impl_->url;
}

tl::expected<void, Failure> PageServer::poll() {
  return contain([this]() -> tl::expected<void, Failure> {
    impl_->poll();
    return {};
  });
}

void PageServer::Impl::poll() {
  context.restart();
  context.poll();
  // Remove closed connections only when none of their operations is pending.
  for (auto& guest : guests)
    if (guest.gone && guest.socket.is_open()) {
      asio::error_code ignored;
      guest.socket.close(ignored);
    }
  context.poll();
  guests.remove_if([](const Guest& guest) { return !guest.socket.is_open(); });
}

void PageServer::send(std::string_view event) {
  for (auto& guest : impl_->guests)
    if (guest.listens && !guest.gone)
      impl_->say(guest, fmt::format("data: {}\n\n", event));
}

std::size_t PageServer::listeners() const {
  return static_cast<std::size_t>(
      std::count_if(impl_->guests.begin(), impl_->guests.end(),
                    [](const Guest& guest) { return guest.listens && !guest.gone; }));
}

} // namespace orb::serve
