#include "src/config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "src/config/config_error.hpp"
#include "src/config/embedded.hpp"
#include "src/config/nearest_word.hpp"

namespace hogline::config {
namespace {

using nlohmann::json;

std::string shortened(const json& value) {
  std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text.size() > 40 ? text.substr(0, 37) + "..." : text;
}

std::string names(const json& properties) {
  std::string text;
  for (const auto& [name, _] : properties.items()) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string range(const json& schema) {
  const std::string kind = schema.value("type", "number") == "integer" ? "a whole number" : "a number";
  if (schema.contains("minimum") && schema.contains("maximum")) {
    return fmt::format("{} from {} to {}", kind, schema["minimum"].dump(), schema["maximum"].dump());
  }
  if (schema.contains("exclusiveMinimum") && schema.contains("maximum")) {
    return fmt::format("{} above {}, at most {}", kind, schema["exclusiveMinimum"].dump(), schema["maximum"].dump());
  }
  if (schema.contains("minimum")) return fmt::format("{} of at least {}", kind, schema["minimum"].dump());
  if (schema.contains("exclusiveMinimum")) return fmt::format("{} above {}", kind, schema["exclusiveMinimum"].dump());
  return kind;
}

std::string allowed(const json& schema) {
  if (schema.contains("enum")) {
    std::string text;
    for (const auto& word : schema["enum"]) text += (text.empty() ? "" : ", ") + shortened(word);
    return "one of " + text;
  }
  const std::string type = schema.value("type", "");
  if (type == "object") return "keys and values: " + names(schema.value("properties", json::object()));
  if (type == "array") {
    const auto least = schema.value("minItems", 0);
    const auto most = schema.value("maxItems", 0);
    const std::string count = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
    return fmt::format("a list of {} values, each {}", count, allowed(schema.value("items", json::object())));
  }
  if (type == "string") return "a word";
  if (type == "boolean") return "true or false";
  return range(schema);
}

const json& resolved(const json& schema, const json& root) {
  if (!schema.contains("$ref")) return schema;
  return root.at(json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
}

// Finds the place of the first error, in the order of the schema; the validator only says that there is one.
class Explainer {
 public:
  Explainer(const json& root, const Document& document) : root_(root), document_(document) {}

  void explain(const json& value, const json& schema_or_ref, const std::string& key) const {
    const json& schema = resolved(schema_or_ref, root_);
    if (value.is_object() && schema.value("type", "") == "object") return explain_object(value, schema, key);
    if (value.is_array() && schema.value("type", "") == "array") return explain_array(value, schema, key);
    if (valid(value, schema)) return;
    const std::string type = schema.value("type", "");
    const bool quoted = value.is_string() && (type == "number" || type == "integer" || type == "boolean") &&
                        reads_otherwise(value.get<std::string>());
    if (quoted)
      refuse(key, "\"" + shortened(value) + "\"", "is a text in quotes; leave them out: must be " + hint(schema));
    refuse(key, shortened(value), "must be " + hint(schema));
  }

 private:
  void explain_object(const json& value, const json& schema, const std::string& key) const {
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, entry] : value.items()) {
      if (!properties.contains(name)) refuse_unknown(join(key, name), name, entry, properties);
    }
    for (const auto& name : schema.value("required", json::array())) {
      const auto word = name.get<std::string>();
      if (!value.contains(word)) {
        refuse(join(key, word), "", "missing; must be " + hint(resolved(properties.at(word), root_)));
      }
    }
    for (const auto& [name, entry] : value.items()) explain(entry, properties.at(name), join(key, name));
    if (value.size() < schema.value("minProperties", 0U)) refuse(key, "", "must hold one of " + names(properties));
  }

  void explain_array(const json& value, const json& schema, const std::string& key) const {
    if (value.size() < schema.value("minItems", 0U) || value.size() > schema.value("maxItems", value.size())) {
      refuse(key, shortened(value), "must be " + hint(schema));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      explain(value[i], schema.value("items", json::object()), fmt::format("{}[{}]", key, i));
    }
  }

  void refuse_unknown(const std::string& key, const std::string& name, const json& value,
                      const json& properties) const {
    std::vector<std::string> known;
    for (const auto& [word, _] : properties.items()) known.push_back(word);
    const std::string meant = nearest_word(name, known);
    const std::string advice = meant.empty() ? "" : fmt::format("did you mean {}? ", meant);
    refuse(key, value.is_structured() ? "" : shortened(value),
           fmt::format("unknown key; {}allowed here: {}", advice, names(properties)));
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& problem) const {
    throw ConfigError(document_.file, document_.line_of(key), key, value, problem);
  }

  static std::string join(const std::string& key, const std::string& name) {
    return key.empty() ? name : key + "." + name;
  }

  static std::string hint(const json& schema) {
    const std::string about = schema.value("description", "");
    return about.empty() ? allowed(schema) : fmt::format("{} ({})", allowed(schema), about);
  }

  // Without quotes it would be no text.
  static bool reads_otherwise(const std::string& text) {
    const json plain = json::parse(text.starts_with('+') ? text.substr(1) : text, nullptr, false);
    return plain.is_number() || plain.is_boolean();
  }

  static bool valid(const json& value, const json& part) {
    valijson::Schema schema;
    valijson::SchemaParser parser;
    const valijson::adapters::NlohmannJsonAdapter part_adapter(part);
    parser.populateSchema(part_adapter, schema);
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    const valijson::adapters::NlohmannJsonAdapter target(value);
    return validator.validate(schema, target, nullptr);
  }

  const json& root_;
  const Document& document_;
};

}  // namespace

void check(const json& value, std::string_view schema_name, const Document& document) {
  const json root = json::parse(embedded_file(schema_name));
  valijson::Schema schema;
  valijson::SchemaParser parser;
  const valijson::adapters::NlohmannJsonAdapter root_adapter(root);
  parser.populateSchema(root_adapter, schema);
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  valijson::ValidationResults results;
  const valijson::adapters::NlohmannJsonAdapter target(value);
  if (validator.validate(schema, target, &results)) return;

  Explainer(root, document).explain(value, root, "");
  valijson::ValidationResults::Error error;
  results.popError(error);
  throw ConfigError(document.file, 0, "", "", error.description);
}

}  // namespace hogline::config
