#include "serve/server.h"

#include "disk/disk.h"
#include "vm/state.h"

#include <algorithm>
#include <array>
#include <asio.hpp>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fcntl.h>
#include <fmt/format.h>
#include <memory>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>
#include <utility>

namespace orb::serve {
namespace {

using Clock = std::chrono::steady_clock;
using asio::ip::tcp;

// Several clients take one packet from each read: a message keeps its distance from the packet in
// front of it, but does not wait for ever (docs/protocol.md).
constexpr Duration message_gap = std::chrono::milliseconds{2};
/// … and more from an answer, which a client may take its time to look at.
constexpr Duration answer_gap = std::chrono::milliseconds{8};
constexpr Duration message_patience = std::chrono::milliseconds{20};
/// Answers leave one by one, unless a pipelining client is owed more than this at once.
constexpr std::size_t answers_apart = 16;
/// How often a pty without a client is looked at for one.
constexpr Duration pty_interval = std::chrono::milliseconds{20};
/// A client that does not read is not read from while this much waits for it.
constexpr std::size_t backlog_most = 256 * 1024;
constexpr std::size_t read_size = 64 * 1024;
/// How much a client that has left is still heard when the next one knocks.
constexpr int farewell_reads = 64;

IoError failure(std::string_view action, const std::string& what, int error,
                std::string_view help = "") {
  return {fmt::format("cannot {} {}: {}{}", action, what, std::strerror(error), help)};
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// The name of the `index`-th of `count` things that are called `name`.
std::string numbered(const std::string& name, int index, int count) {
  return count == 1 || name.empty() ? name : fmt::format("{}-{}", name, index + 1);
}

/// The master side of a raw pty, and the symlink to its slave.
class Pty {
public:
  Pty() = default;
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;
  ~Pty() {
    if (!link_.empty())
      ::unlink(link_.c_str());
    if (fd_ >= 0)
      ::close(fd_);
  }

  tl::expected<void, IoError> open(const std::string& link) {
    fd_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    std::array<char, 128> name{};
    if (fd_ < 0 || ::grantpt(fd_) != 0 || ::unlockpt(fd_) != 0 ||
        ::ptsname_r(fd_, name.data(), name.size()) != 0)
      return tl::unexpected(failure("open", "a pty", errno));
    slave_ = name.data();
    make_raw();
    if (link.empty())
      return {};
    struct stat status {};
    if (::lstat(link.c_str(), &status) == 0) {
      if (!S_ISLNK(status.st_mode))
        return tl::unexpected(
            IoError{fmt::format("`{}` exists and is no link; give another name", link)});
      ::unlink(link.c_str()); // left over from a run that was killed
    }
    if (::symlink(slave_.c_str(), link.c_str()) != 0)
      return tl::unexpected(failure("make link", link, errno));
    link_ = link;
    return {};
  }

  /// No echo, no translation, no signals; and nothing left over from the client before. Opening
  /// and closing the slave also brings the master into its state without a client.
  void make_raw() const {
    const int slave = ::open(slave_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (slave < 0)
      return;
    termios settings{};
    if (::tcgetattr(slave, &settings) == 0) {
      ::cfmakeraw(&settings);
      ::tcsetattr(slave, TCSANOW, &settings);
    }
    ::tcflush(slave, TCIOFLUSH);
    ::close(slave);
  }

  bool has_client() const {
    pollfd query{fd_, POLLIN, 0};
    return ::poll(&query, 1, 0) >= 0 && (query.revents & POLLHUP) == 0;
  }

  int fd() const { return fd_; }
  const std::string& name() const { return link_.empty() ? slave_ : link_; }

private:
  int fd_ = -1;
  std::string slave_;
  std::string link_;
};

/// One ball in real time, with its links and its client.
class Served {
public:
  Served(asio::io_context& io, const ServeOptions& options, int index)
      : options_(options), index_(index), ball_(ball_options(options, index)), acceptor_(io),
        socket_(io), master_(io), timer_(io), pty_timer_(io) {
    if (options.fault)
      pipe_.emplace(*options.fault);
    ball_.schedule(options.stimulus);
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  ~Served() {
    asio::error_code ignored;
    if (master_.is_open())
      master_.release(); // pty_ closes it
    socket_.close(ignored);
  }

  tl::expected<void, IoError> open();
  /// Begins to live; `start` is the moment at which balls have time 0.
  void start(Clock::time_point start);
  /// The lines that tell clients where the ball is.
  std::string addresses() const;
  tl::expected<void, IoError> save();
  const std::optional<IoError>& error() const { return error_; }

private:
  enum class Client : std::uint8_t { None, Tcp, Pty };

  struct Message {
    Bytes bytes;
    Instant since;
  };

  static vm::BallOptions ball_options(const ServeOptions& options, int index) {
    auto ball = options.ball;
    ball.seed += static_cast<std::uint64_t>(index);
    ball.wire = vm::Wire::Unpaced;
    return ball;
  }

  tl::expected<void, IoError> listen();
  tl::expected<void, IoError> load();

  /// The ball's time: the steady clock, scaled.
  Instant now() const {
    const std::chrono::duration<double, std::nano> real = Clock::now() - start_;
    return Instant{} + Duration{static_cast<Duration::rep>(real.count() * options_.speed)};
  }
  Duration real_time() const { return std::chrono::duration_cast<Duration>(Clock::now() - start_); }

  void accept();
  void on_accept(tcp::socket socket);
  bool peer_left();
  void look_at_pty();
  void join(Client client);
  void leave();
  int client_fd() { return client_ == Client::Tcp ? socket_.native_handle() : pty_.fd(); }
  template <class Handler>
  void wait_client(asio::socket_base::wait_type type, Handler handler);

  void await_input();
  void on_input();
  void step();
  void take_packets();
  void send_answers();
  void send_messages();
  void send_faulty(ByteView packet);
  void write(ByteView bytes);
  void write_backlog();
  void lose_client();
  void arm();
  void log(char direction, ByteView bytes);

  const ServeOptions& options_;
  int index_;
  vm::Ball ball_;
  std::optional<protocol::FaultPipe> pipe_;
  Clock::time_point start_;

  tcp::acceptor acceptor_;
  tcp::socket socket_;
  Pty pty_;
  asio::posix::stream_descriptor master_;
  asio::steady_timer timer_;
  Clock::time_point armed_ = Clock::time_point::max();
  asio::steady_timer pty_timer_;
  Client client_ = Client::None;
  std::uint64_t session_ = 0; ///< tells the handlers of a client that left from those of the next

  std::vector<Bytes> answers_;
  std::deque<Message> messages_;
  Instant message_at_{}; ///< before which no message leaves; in real time, like the gaps
  Bytes backlog_;        ///< what the client has not taken yet
  bool writing_ = false;
  bool reading_ = false;

  File log_;
  std::uint64_t saved_revision_ = 0;
  std::optional<IoError> error_;
};

tl::expected<void, IoError> Served::listen() {
  if (!options_.tcp)
    return {};
  asio::error_code error;
  tcp::resolver resolver(acceptor_.get_executor());
  const auto found =
      resolver.resolve(options_.tcp->host, "0", tcp::resolver::numeric_service, error);
  if (error || found.empty())
    return tl::unexpected(
        IoError{fmt::format("cannot find the host `{}`: {}; write an address of this "
                            "machine such as 127.0.0.1",
                            options_.tcp->host, error.message())});
  auto endpoint = found.begin()->endpoint();
  const auto wanted = options_.tcp->port;
  const auto port = wanted == 0 ? 0 : wanted + index_;
  const auto place = fmt::format("{}:{}", options_.tcp->host, port);
  if (port > UINT16_MAX)
    return tl::unexpected(IoError{fmt::format("port {} does not exist; begin lower", port)});
  endpoint.port(static_cast<std::uint16_t>(port));
  acceptor_.open(endpoint.protocol(), error);
  if (!error)
    acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error)
    acceptor_.bind(endpoint, error);
  if (!error)
    acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error)
    return tl::unexpected(IoError{
        fmt::format("cannot listen on {}: {}; port 0 picks a free one", place, error.message())});
  return {};
}

tl::expected<void, IoError> Served::load() {
  const auto path = numbered(options_.state_file, index_, options_.count);
  if (path.empty() || ::access(path.c_str(), F_OK) != 0)
    return {}; // a new ball
  const auto text = disk::read(path);
  if (!text)
    return tl::unexpected(text.error());
  if (const auto loaded = vm::load_state(*text, ball_); !loaded)
    return tl::unexpected(IoError{fmt::format(
        "{} is no state of a ball: {}; remove it to begin with a new ball", path, loaded.error())});
  saved_revision_ = ball_.dispatcher().revision();
  return {};
}

tl::expected<void, IoError> Served::open() {
  if (auto loaded = load(); !loaded)
    return loaded;
  if (!options_.log_file.empty()) {
    const auto path = numbered(options_.log_file, index_, options_.count);
    log_.reset(std::fopen(path.c_str(), "we"));
    if (!log_)
      return tl::unexpected(failure("write", path, errno));
  }
  if (auto listening = listen(); !listening)
    return listening;
  if (options_.pty) {
    if (auto opened = pty_.open(numbered(options_.pty_link, index_, options_.count)); !opened)
      return opened;
    master_.assign(pty_.fd());
  }
  return {};
}

tl::expected<void, IoError> Served::save() {
  if (options_.state_file.empty())
    return {};
  saved_revision_ = ball_.dispatcher().revision();
  return disk::write(numbered(options_.state_file, index_, options_.count),
                     as_bytes(vm::save_state(ball_)));
}

std::string Served::addresses() const {
  std::string out;
  if (options_.pty)
    out += fmt::format("pty {}\n", pty_.name());
  if (acceptor_.is_open()) {
    const auto place = acceptor_.local_endpoint();
    const auto host = place.address().to_string();
    out += place.address().is_v6() ? fmt::format("tcp [{}]:{}\n", host, place.port())
                                   : fmt::format("tcp {}:{}\n", host, place.port());
  }
  return out;
}

void Served::start(Clock::time_point start) {
  start_ = start;
  if (acceptor_.is_open())
    accept();
  if (options_.pty)
    look_at_pty();
  step();
}

// Clients come and go.

void Served::accept() {
  acceptor_.async_accept([this](asio::error_code error, tcp::socket socket) {
    if (!error)
      on_accept(std::move(socket));
    if (error != asio::error::operation_aborted)
      accept();
  });
}

void Served::on_accept(tcp::socket socket) {
  if (client_ == Client::Tcp && peer_left()) {
    // Hear what it said at last before the next one is let in.
    const auto session = session_;
    for (int i = 0; i < farewell_reads && session == session_; ++i)
      on_input();
    if (session == session_)
      leave();
  }
  if (client_ != Client::None)
    return; // one client at a time: closing the socket is the refusal
  asio::error_code ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  socket.native_non_blocking(true, ignored);
  socket_ = std::move(socket);
  join(Client::Tcp);
}

bool Served::peer_left() {
  pollfd query{client_fd(), POLLRDHUP, 0};
  return ::poll(&query, 1, 0) > 0;
}

void Served::look_at_pty() {
  if (client_ == Client::None && pty_.has_client())
    join(Client::Pty);
  if (client_ == Client::Pty)
    return; // leave() comes back here
  if (client_ == Client::Tcp) {
    // Who writes to the pty meanwhile is not heard, now or later.
    std::array<char, 4096> unheard;
    while (::read(pty_.fd(), unheard.data(), unheard.size()) > 0)
      ;
  }
  pty_timer_.expires_after(pty_interval);
  pty_timer_.async_wait([this](asio::error_code error) {
    if (!error)
      look_at_pty();
  });
}

void Served::join(Client client) {
  client_ = client;
  ++session_;
  ball_.advance_to(now());
  ball_.connect();
  if (pipe_)
    pipe_->reconnect(now());
  await_input();
  step();
}

void Served::leave() {
  if (client_ == Client::None)
    return;
  const auto was = std::exchange(client_, Client::None);
  ++session_;
  answers_.clear();
  messages_.clear();
  backlog_.clear();
  writing_ = reading_ = false;
  asio::error_code ignored;
  if (was == Client::Tcp)
    socket_.close(ignored);
  ball_.advance_to(now());
  ball_.disconnect();
  if (was == Client::Pty) {
    master_.cancel(ignored);
    pty_.make_raw();
    look_at_pty();
  }
  step();
}

template <class Handler>
void Served::wait_client(asio::socket_base::wait_type type, Handler handler) {
  const auto guarded = [this, session = session_, handler](asio::error_code error) {
    if (session != session_ || error == asio::error::operation_aborted)
      return;
    handler();
  };
  if (client_ == Client::Tcp)
    socket_.async_wait(type, guarded);
  else
    master_.async_wait(static_cast<asio::posix::stream_descriptor::wait_type>(type), guarded);
}

// Bytes in.

void Served::await_input() {
  if (reading_ || client_ == Client::None || backlog_.size() > backlog_most)
    return;
  reading_ = true;
  wait_client(asio::socket_base::wait_read, [this] {
    reading_ = false;
    on_input();
  });
}

void Served::on_input() {
  static thread_local std::array<std::uint8_t, read_size> buffer;
  const auto size = client_ == Client::Tcp ? ::recv(client_fd(), buffer.data(), buffer.size(), 0)
                                           : ::read(client_fd(), buffer.data(), buffer.size());
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
    await_input();
    return;
  }
  if (size <= 0) { // the end, or EIO when the slave of a pty was closed
    leave();
    return;
  }
  const auto bytes = ByteView(buffer).first(static_cast<std::size_t>(size));
  log('>', bytes);
  ball_.advance_to(now());
  if (pipe_)
    pipe_->push(protocol::Direction::ToBall, bytes, now());
  else
    ball_.receive(bytes);
  const auto session = session_;
  step();
  if (session == session_)
    await_input();
}

// Time passes, packets leave.

void Served::step() {
  const auto time = now();
  ball_.advance_to(time);
  if (pipe_) {
    for (auto bytes = pipe_->take(protocol::Direction::ToBall, time); !bytes.empty();
         bytes = pipe_->take(protocol::Direction::ToBall, time))
      ball_.receive(bytes);
    ball_.advance_to(time);
  }
  if (!options_.state_file.empty() && ball_.dispatcher().revision() != saved_revision_)
    if (auto saved = save(); !saved)
      error_ = saved.error(); // answers still go out: the ball itself has changed
  take_packets();
  const auto session = session_;
  if (pipe_) {
    for (auto bytes = pipe_->take(protocol::Direction::FromBall, time);
         !bytes.empty() && session == session_;
         bytes = pipe_->take(protocol::Direction::FromBall, time))
      write(bytes);
    if (pipe_->cut() && session == session_)
      leave();
  } else {
    send_answers();
    send_messages();
  }
  // Sleep ends the connection; a pty cannot hang up, its client is just not heard any more.
  if (session == session_ && client_ == Client::Tcp && !ball_.connected() && backlog_.empty() &&
      messages_.empty())
    leave();
  arm();
}

void Served::take_packets() {
  while (auto packet = ball_.take_packet()) {
    if (client_ == Client::None)
      continue;
    if (pipe_) {
      pipe_->push(protocol::Direction::FromBall, *packet, now());
      continue;
    }
    const auto is_message = (*packet)[1] == spec::sop2_async;
    if (is_message) {
      if (backlog_.size() <= backlog_most)
        messages_.push_back({std::move(*packet), Instant{} + real_time()});
      continue;
    }
    if (!messages_.empty() && ball_.streamer().next_event() == never) {
      // Once streaming has stopped, no sensor data may follow the answer that says so.
      send_answers();
      for (const auto& message : messages_)
        write(message.bytes);
      messages_.clear();
    }
    answers_.push_back(std::move(*packet));
  }
}

void Served::send_answers() {
  if (answers_.empty())
    return;
  auto answers = std::exchange(answers_, {});
  if (answers.size() > answers_apart) {
    auto& all = answers.front();
    for (std::size_t i = 1; i < answers.size(); ++i)
      all.insert(all.end(), answers[i].begin(), answers[i].end());
    answers.resize(1);
  }
  for (const auto& bytes : answers)
    write(bytes);
  message_at_ = Instant{} + real_time() + answer_gap;
}

void Served::send_messages() {
  while (!messages_.empty()) {
    const auto time = Instant{} + real_time();
    const auto& message = messages_.front();
    if (time < message_at_ && time < message.since + message_patience)
      return;
    const auto bytes = std::move(messages_.front().bytes);
    messages_.pop_front();
    message_at_ = time + message_gap;
    write(bytes);
  }
}

void Served::write(ByteView bytes) {
  if (client_ == Client::None)
    return;
  log('<', bytes);
  if (backlog_.empty()) {
    const auto sent = client_ == Client::Tcp
                          ? ::send(client_fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                          : ::write(client_fd(), bytes.data(), bytes.size());
    if (sent > 0)
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
    else if (sent < 0 && errno != EAGAIN && errno != EINTR)
      return lose_client();
  }
  if (bytes.empty())
    return;
  backlog_.insert(backlog_.end(), bytes.begin(), bytes.end());
  write_backlog();
}

/// Leaves as soon as whoever writes has returned.
void Served::lose_client() {
  asio::post(timer_.get_executor(), [this, session = session_] {
    if (session == session_)
      leave();
  });
}

void Served::write_backlog() {
  if (writing_)
    return;
  writing_ = true;
  wait_client(asio::socket_base::wait_write, [this] {
    writing_ = false;
    const auto bytes = std::exchange(backlog_, {});
    const auto sent = client_ == Client::Tcp
                          ? ::send(client_fd(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                          : ::write(client_fd(), bytes.data(), bytes.size());
    if (sent < 0 && errno != EAGAIN && errno != EINTR)
      return leave();
    backlog_.assign(bytes.begin() + std::max<std::ptrdiff_t>(0, sent), bytes.end());
    if (!backlog_.empty())
      write_backlog();
    await_input();
  });
}

/// Sleeps until something happens by itself.
void Served::arm() {
  auto wake = Clock::time_point::max();
  const auto next = std::min(ball_.next_event(), pipe_ ? pipe_->next_due() : never);
  if (next != never) {
    const auto real = static_cast<double>(next.time_since_epoch().count()) / options_.speed;
    constexpr double century = 3e18;
    if (real < century)
      wake = start_ + Duration{static_cast<Duration::rep>(real) + 1};
  }
  if (!messages_.empty())
    wake = std::min(
        wake,
        start_ +
            std::min(message_at_, messages_.front().since + message_patience).time_since_epoch());
  if (wake == armed_)
    return;
  armed_ = wake;
  if (wake == Clock::time_point::max()) {
    timer_.cancel();
    return;
  }
  timer_.expires_at(wake);
  timer_.async_wait([this](asio::error_code error) {
    if (error)
      return;
    armed_ = Clock::time_point::max();
    step();
  });
}

void Served::log(char direction, ByteView bytes) {
  if (!log_)
    return;
  fmt::print(log_.get(), "{} {}\n", direction, to_hex(bytes));
  std::fflush(log_.get());
}

} // namespace

tl::expected<void, IoError> serve(const ServeOptions& options) {
  asio::io_context io{1};
  asio::signal_set signals(io, SIGINT, SIGTERM);
  signals.async_wait([&io](asio::error_code, int) { io.stop(); });

  std::vector<std::unique_ptr<Served>> balls;
  std::string addresses;
  for (int i = 0; i < options.count; ++i) {
    balls.push_back(std::make_unique<Served>(io, options, i));
    if (auto opened = balls.back()->open(); !opened)
      return opened;
    addresses += balls.back()->addresses();
  }
  options.announce(addresses);
  const auto start = Clock::now();
  for (const auto& ball : balls)
    ball->start(start);
  io.run();

  std::optional<IoError> error;
  for (const auto& ball : balls) {
    if (auto saved = ball->save(); !saved)
      error = saved.error();
    else if (ball->error())
      error = ball->error();
  }
  if (error)
    return tl::unexpected(*error);
  return {};
}

} // namespace orb::serve
