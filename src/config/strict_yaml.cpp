#include "src/config/strict_yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "src/config/config_error.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

class Reader {
 public:
  explicit Reader(Document& document) : document_(document) {}

  json read(const YAML::Node& node, const std::string& key) {
    // Aliases of aliases grow without bound; no rig or scenario comes near this.
    if (++nodes_ > most_nodes) throw ConfigError(document_.file, 0, "", "", "holds too many values; write aliases out");
    const int line = node.Mark().is_null() ? 0 : node.Mark().line + 1;
    document_.lines.try_emplace(key, line);
    switch (node.Type()) {
      case YAML::NodeType::Map:
        return read_map(node, key);
      case YAML::NodeType::Sequence:
        return read_sequence(node, key);
      case YAML::NodeType::Scalar:
        return read_scalar(node, key);
      case YAML::NodeType::Null:
        return nullptr;
      case YAML::NodeType::Undefined:
        break;
    }
    return nullptr;
  }

 private:
  json read_map(const YAML::Node& node, const std::string& key) {
    json object = json::object();
    for (const auto& entry : node) {
      const int line = entry.first.Mark().line + 1;
      if (!entry.first.IsScalar()) throw ConfigError(document_.file, line, key, "", "a key must be a plain word");
      const std::string name = entry.first.Scalar();
      const std::string path = key.empty() ? name : key + "." + name;
      if (object.contains(name))
        throw ConfigError(document_.file, line, path, "", "this key stands here twice; keep one");
      document_.lines[path] = line;
      object[name] = read(entry.second, path);
    }
    return object;
  }

  json read_sequence(const YAML::Node& node, const std::string& key) {
    json array = json::array();
    for (std::size_t i = 0; i < node.size(); ++i) array.push_back(read(node[i], fmt::format("{}[{}]", key, i)));
    return array;
  }

  json read_scalar(const YAML::Node& node, const std::string& key) {
    const std::string& text = node.Scalar();
    if (node.Tag() == "!") return text;  // quoted
    if (text == "true" || text == "false") return text == "true";
    if (const auto number = read_number(text)) {
      if (!std::isfinite(number->get<double>())) {
        throw ConfigError(document_.file, document_.line_of(key), key, text, "must be a finite number");
      }
      return *number;
    }
    return text;
  }

  static std::optional<json> read_number(const std::string& text) {
    if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::nan("");
    if (text == ".inf" || text == "+.inf" || text == "-.inf" || text == ".Inf" || text == "-.Inf") return HUGE_VAL;
    if (text.starts_with("+-") || text.starts_with("0x-")) return std::nullopt;
    const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
    const char* end = text.data() + text.size();
    long long integer = 0;
    if (text.starts_with("0x")) {
      const auto r = std::from_chars(begin + 2, end, integer, 16);
      return r.ec == std::errc{} && r.ptr == end ? std::optional<json>(integer) : std::nullopt;
    }
    if (const auto r = std::from_chars(begin, end, integer); r.ec == std::errc{} && r.ptr == end) return integer;
    double real = 0.0;
    const auto r = std::from_chars(begin, end, real);
    if (r.ptr == end && r.ec == std::errc{}) return real;
    if (r.ptr == end && r.ec == std::errc::result_out_of_range) return HUGE_VAL;
    return std::nullopt;
  }

  static constexpr int most_nodes = 20000;

  Document& document_;
  int nodes_ = 0;
};

class Ignore final : public YAML::EventHandler {
  using Mark = YAML::Mark;
  using Anchor = YAML::anchor_t;
  using Text = const std::string&;
  void OnDocumentStart(const Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const Mark&, Anchor) override {}
  void OnAlias(const Mark&, Anchor) override {}
  void OnScalar(const Mark&, Text, Anchor, Text) override {}
  void OnSequenceStart(const Mark&, Text, Anchor, YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark&, Text, Anchor, YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// YAML::LoadAll would tell, but on some broken texts (",\n---\vb") yaml-cpp 0.7 finds documents for ever.
bool is_one_document(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Ignore events;
  return parser.HandleNextDocument(events) && !parser.HandleNextDocument(events);
}

}  // namespace

int Document::line_of(const std::string& key) const {
  std::string path = key;
  while (!path.empty()) {
    if (const auto found = lines.find(path); found != lines.end()) return found->second;
    const auto cut = path.find_last_of(".[");
    if (cut == std::string::npos) break;
    path.resize(cut);
  }
  return 0;
}

json read_yaml(std::string_view text, Document& document) {
  YAML::Node root;
  bool one = false;
  try {
    one = is_one_document(std::string(text));
    if (one) root = YAML::Load(std::string(text));
  } catch (const YAML::Exception& e) {
    throw ConfigError(document.file, e.mark.line + 1, "", "", fmt::format("not YAML: {}", e.msg));
  }
  if (!one || !root.IsMap()) {
    throw ConfigError(document.file, 0, "", "", "must hold one YAML document of keys and values");
  }
  return Reader(document).read(root, "");
}

std::string read_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw ConfigError(path, 0, "", "", "no such file");
  if (!std::filesystem::is_regular_file(path, error)) throw ConfigError(path, 0, "", "", "not a file");
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw ConfigError(path, 0, "", "", "can not be read; check its permissions");
  return text.str();
}

}  // namespace hogline::config
