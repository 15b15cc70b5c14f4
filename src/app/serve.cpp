/// A run folder over HTTP, for a browser on this machine or at the other end of an ssh tunnel.
#include <fmt/format.h>
#include <httplib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <utility>

#include "app/control.hpp"
#include "app/options.hpp"
#include "app/run_lock.hpp"
#include "base/errors.hpp"

namespace ejecta {

namespace {

namespace fs = std::filesystem;

constexpr const char* loopback = "127.0.0.1";
constexpr int first_port = 8080, ports_tried = 100;
constexpr std::size_t longest_line = 200;  // of control
constexpr double patience = 10;            // for the answer of a run [s]

constexpr std::array types{std::pair{".html", "text/html; charset=utf-8"},
                           std::pair{".js", "text/javascript; charset=utf-8"},
                           std::pair{".json", "application/json"},
                           std::pair{".csv", "text/csv; charset=utf-8"},
                           std::pair{".toml", "text/plain; charset=utf-8"},
                           std::pair{".log", "text/plain; charset=utf-8"},
                           std::pair{".gp", "text/plain; charset=utf-8"},
                           std::pair{".py", "text/plain; charset=utf-8"},
                           std::pair{".png", "image/png"},
                           std::pair{".jpg", "image/jpeg"},
                           std::pair{".mp4", "video/mp4"},
                           std::pair{".h5", "application/x-hdf5"}};

std::string type_of(const fs::path& file) {
  const auto known = std::ranges::find(types, file.extension().string(), [](const auto& t) { return t.first; });
  return known == types.end() ? "application/octet-stream" : known->second;
}

/// The file that the path of an address means, once %-escapes are read. Nothing for what is not there, is no plain
/// file, or leads out of the folder, by ".." or by a link.
std::optional<fs::path> served_file(const fs::path& folder, const std::string& path) {
  if (std::ranges::any_of(path, [](unsigned char c) { return c < ' '; })) return {};  // a zero would end the name
  std::error_code missing;
  const fs::path root = fs::canonical(folder, missing);
  if (missing) return {};
  const fs::path file = fs::canonical(root / fs::path(path).relative_path(), missing);
  if (missing || !fs::is_regular_file(file, missing)) return {};
  if (std::ranges::mismatch(root, file).in1 != root.end()) return {};
  return file;
}

/// A page from elsewhere, whose name is made to lead here, must not read or ask for anything.
bool meant_for_us(const httplib::Request& request) {
  const std::string host = request.get_header_value("Host");
  const std::string name = host.substr(0, host.rfind(':'));
  return name == "localhost" || name == loopback || name == "[::1]";
}

/// Changes with the file.
std::string tag_of(const struct stat& file) {
  return fmt::format("\"{:x}-{:x}-{:x}\"", file.st_ino, file.st_size,
                     1'000'000'000 * file.st_mtim.tv_sec + file.st_mtim.tv_nsec);
}

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
}

/// What the library leaves open: brings the one range that is asked for into the file. False if it lies beyond the end.
/// Of several, which nobody needs here, none is left: then the whole file is sent.
bool fit_range(httplib::Ranges& ranges, ssize_t size) {
  if (ranges.size() != 1) ranges.clear();
  for (auto& [first, last] : ranges) {
    if (first < 0) {  // the last so many bytes
      first = std::max<ssize_t>(0, size - last);
      last = size - 1;
    }
    if (last < 0 || last >= size) last = size - 1;
    if (first > last) return false;
  }
  return true;
}

void send_file(const fs::path& file, const httplib::Request& request, httplib::Response& response) {
  std::FILE* opened = std::fopen(file.c_str(), "rb");
  if (!opened) return refuse(response, 404, "not there");
  const std::shared_ptr<std::FILE> in(opened, std::fclose);  // a file that is replaced meanwhile is sent as it was
  struct stat found {};
  fstat(fileno(opened), &found);
  const std::string tag = tag_of(found);
  response.set_header("ETag", tag);
  response.set_header("Cache-Control", "no-cache");  // always ask whether it has changed
  const std::string known = request.get_header_value("If-None-Match");
  if (known == "*" || known.find(tag) != std::string::npos) {
    response.status = 304;
    return;
  }
  // The library sends what stands here when the handler is done.
  httplib::Ranges& ranges = const_cast<httplib::Request&>(request).ranges;
  if (request.has_header("If-Range") && request.get_header_value("If-Range") != tag) ranges.clear();
  if (!fit_range(ranges, found.st_size)) {
    ranges.clear();
    response.set_header("Content-Range", fmt::format("bytes */{}", found.st_size));
    return refuse(response, 416, "beyond the end of the file");
  }
  if (found.st_size == 0) return response.set_content("", type_of(file));
  const auto send = [in](std::size_t from, std::size_t count, httplib::DataSink& out) {
    std::array<char, 1 << 16> block;
    const ssize_t got = pread(fileno(in.get()), block.data(), std::min(count, block.size()), static_cast<off_t>(from));
    return got > 0 && out.write(block.data(), static_cast<std::size_t>(got));
  };
  response.set_content_provider(static_cast<std::size_t>(found.st_size), type_of(file), send);
}

std::string new_token() {
  std::random_device random;
  std::string token;
  for (int k = 0; k < 4; ++k) token += fmt::format("{:08x}", random());
  return token;
}

/// Takes as long for every wrong token.
bool same(const std::string& a, const std::string& b) {
  unsigned differences = a.size() != b.size();
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) differences |= static_cast<unsigned char>(a[k] ^ b[k]);
  return differences == 0;
}

/// Binds the port that was asked for, or the first free one.
int bind(httplib::Server& server, int asked) {
  if (asked > 0) {
    if (server.bind_to_port(loopback, asked)) return asked;
    throw InputError(fmt::format("--port: expected a free port, got {}, which is taken or not allowed", asked));
  }
  for (int port = first_port; port < first_port + ports_tried; ++port)
    if (server.bind_to_port(loopback, port)) return port;
  throw InputError(
      fmt::format("--port: expected a free port, ports {} to {} are taken", first_port, first_port + ports_tried - 1));
}

}  // namespace

int serve_command(const ServeOptions& options) {
  const fs::path given = options.folder;
  if (!fs::exists(given / "monitor" / "index.html") && !run_in(given))  // a run that has just begun has no page yet
    throw InputError(options.folder + ": expected a run folder, found neither a run nor monitor/index.html in it");
  const fs::path folder = fs::absolute(options.folder);
  const std::string token = new_token();
  std::mutex one_line_at_a_time;
  httplib::Server server;
  server.set_socket_options([](socket_t socket) {  // the library's own would share the port with another server
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  server.set_payload_max_length(longest_line);
  server.set_default_headers({{"X-Content-Type-Options", "nosniff"}, {"X-Frame-Options", "DENY"}});
  server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
    using Done = httplib::Server::HandlerResponse;
    if (!meant_for_us(request)) {
      refuse(response, 403, "expected localhost as the host");
    } else if (request.method == "GET" || request.method == "HEAD") {
      if (request.path == "/")
        response.set_redirect("/monitor/index.html");
      else if (const auto file = served_file(folder, request.path))
        send_file(*file, request, response);
      else
        refuse(response, 404, "not there");
    } else if (options.control && request.method == "POST" && request.path == "/control") {
      return Done::Unhandled;  // goes on below, once its line has been read
    } else {
      refuse(response, 405, options.control ? "expected GET, or POST to /control" : "expected GET: all is read-only");
    }
    return Done::Handled;
  });
  server.Post("/control", [&](const httplib::Request& request, httplib::Response& response) {
    if (!same(request.get_header_value("X-Ejecta-Token"), token))
      return refuse(response, 403, "expected the token that ejecta serve has printed");
    const std::scoped_lock wait(one_line_at_a_time);
    try {
      const std::string answer = send_control(folder, request.body, patience);
      response.set_content((answer.empty() ? "the run has not answered yet" : answer) + "\n",
                           "text/plain; charset=utf-8");
    } catch (const InputError& error) {
      refuse(response, 400, error.what());
    } catch (const std::runtime_error& error) {
      refuse(response, 500, error.what());
    }
  });
  const int port = bind(server, options.port);
  const std::string address = fmt::format("http://{}:{}/", loopback, port);
  fmt::print("{}{}\n{}\nFrom elsewhere: ssh -L {}:{}:{} HOST, then the same address there. Ctrl-C ends it.\n", address,
             options.control ? "#" + token : "",
             options.control ? "Whoever has this address can steer the run." : "Read-only; --control adds buttons.",
             port, loopback, port);
  std::fflush(stdout);
  server.listen_after_bind();
  return exit_code::done;
}

}  // namespace ejecta
