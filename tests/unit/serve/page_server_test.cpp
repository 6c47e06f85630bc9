#include "serve/page_server.h"

#include <asio.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace orb::serve {
namespace {

/// A page server and a client that talks to it byte by byte.
class PageServerTest : public testing::Test {
protected:
  void SetUp() override {
    auto made = PageServer::start("the page", [this](std::string_view path, std::string_view body) {
      if (path == "bug")
        throw std::runtime_error("a vase fell");
      posts.push_back(fmt::format("{}:{}", path, body));
    });
    ASSERT_TRUE(made) << made.error().message;
    server = *std::move(made);
    const auto& url = server->url();
    const auto place = url.find("127.0.0.1:") + std::string_view("127.0.0.1:").size();
    const auto slash = url.find('/', place);
    secret = url.substr(slash);
    port = static_cast<std::uint16_t>(std::stoi(url.substr(place, slash - place)));
  }

  /// Returns the answer to these bytes until the server closes the connection.
  std::string ask(std::string_view bytes) {
    asio::io_context context;
    asio::ip::tcp::socket socket(context);
    socket.connect({asio::ip::address_v4::loopback(), port});
    asio::write(socket, asio::buffer(bytes));
    socket.non_blocking(true);
    std::string answer;
    for (int i = 0; i < 200; ++i) {
      polled = server->poll();
      char piece[4096];
      asio::error_code error;
      const auto n = socket.read_some(asio::buffer(piece), error);
      answer.append(piece, n);
      if (!polled || (error && error != asio::error::would_block))
        break;
    }
    return answer.substr(0, answer.find("\r\n"));
  }

  std::unique_ptr<PageServer> server;
  std::vector<std::string> posts;
  std::string secret;
  std::uint16_t port = 0;
  tl::expected<void, Failure> polled;
};

TEST_F(PageServerTest, ServesThePageAndHearsPosts) {
  EXPECT_EQ(ask("GET " + secret + " HTTP/1.1\r\n\r\n"), "HTTP/1.1 200 OK");
  EXPECT_EQ(ask("POST " + secret + "drive HTTP/1.1\r\nContent-Length: 5\r\n\r\n90 60"),
            "HTTP/1.1 204 No Content");
  EXPECT_EQ(ask("POST " + secret + "stop HTTP/1.1\r\n\r\n"), "HTTP/1.1 204 No Content");
  EXPECT_EQ(posts, (std::vector<std::string>{"drive:90 60", "stop:"}));
}

TEST_F(PageServerTest, AnswersWhateverComes) {
  constexpr std::string_view refused = "HTTP/1.1 400 Bad Request";
  for (const auto* field :
       {"Content-Length:", "Content-Length: ", "Content-Length: x", "Content-Length: -1",
        "Content-Length: 1025", "Content-Length: 99999999999999999999"}) {
    EXPECT_EQ(ask("POST " + secret + "drive HTTP/1.1\r\n" + field + "\r\n\r\n"), refused) << field;
    EXPECT_TRUE(polled) << field << ": " << polled.error().message;
  }
  EXPECT_EQ(ask("\r\n\r\n"), refused);
  EXPECT_EQ(ask(" \r\n\r\n"), refused);
  EXPECT_EQ(ask(std::string(20000, 'x')), "");
  EXPECT_TRUE(posts.empty());
  EXPECT_EQ(ask("GET " + secret + " HTTP/1.1\r\n\r\n"), "HTTP/1.1 200 OK");
}

TEST_F(PageServerTest, WhoDoesNotKnowTheSecretIsNotReadFrom) {
  constexpr std::string_view nothing = "HTTP/1.1 404 Not Found";
  EXPECT_EQ(ask("POST / HTTP/1.1\r\nContent-Length:\r\n\r\n"), nothing);
  EXPECT_EQ(ask("POST / HTTP/1.1\r\nContent-Length: 1000\r\n\r\n"), nothing) << "waits for a body";
  EXPECT_EQ(ask("GET " + secret.substr(0, secret.size() - 1) + " HTTP/1.1\r\n\r\n"), nothing);
  EXPECT_TRUE(polled);
}

TEST_F(PageServerTest, WhoSaysNothingMakesWay) {
  asio::io_context context;
  std::vector<asio::ip::tcp::socket> silent;
  for (int i = 0; i < 40; ++i) {
    silent.emplace_back(context).connect({asio::ip::address_v4::loopback(), port});
    ASSERT_TRUE(server->poll());
  }
  EXPECT_EQ(ask("POST " + secret + "stop HTTP/1.1\r\n\r\n"), "HTTP/1.1 204 No Content");
  EXPECT_EQ(posts, std::vector<std::string>{"stop:"});
}

TEST_F(PageServerTest, AnErrorOfWhoeverHearsThePostsIsNoException) {
  ask("POST " + secret + "bug HTTP/1.1\r\n\r\n");
  ASSERT_FALSE(polled);
  EXPECT_EQ(polled.error().code, ExitCode::Bug);
  EXPECT_NE(polled.error().message.find("a vase fell"), std::string::npos);
}

} // namespace
} // namespace orb::serve
