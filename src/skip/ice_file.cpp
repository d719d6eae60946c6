#include "src/skip/ice_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "servo/ice_model.hpp"
#include "src/config/config_error.hpp"
#include "src/config/schema.hpp"
#include "src/config/section.hpp"
#include "src/config/strict_yaml.hpp"
#include "src/output/output_file.hpp"

namespace hogline {

std::optional<servo::IceEstimate> load_ice(const std::string& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  return parse_ice(config::read_file(path), path);
}

servo::IceEstimate parse_ice(std::string_view text, const std::string& name) {
  config::Document document{.file = name, .lines = {}};
  const nlohmann::json root = config::read_yaml(text, document);
  config::check(root, "ice.schema.json", document);
  const config::Section s(root);
  servo::IceEstimate ice;
  ice.friction_scale = s.number("friction_scale");
  ice.curl_gain = s.number("curl_gain");
  ice.lateral_mps2 = s.number("lateral_mps2");
  for (std::size_t i = 0; i < ice.covariance.size(); ++i) ice.covariance[i] = s.raw("covariance")[i].get<double>();
  ice.throws = s.integer("throws");
  if (const auto why = servo::refusal(ice)) {
    throw config::ConfigError(name, document.line_of("covariance"), "covariance", "", *why);
  }
  return ice;
}

std::string ice_text(const servo::IceEstimate& ice) {
  return fmt::format(
      "# What throws have taught of a sheet's ice: written by `hogline skip`, frame s.\n"
      "version: 1\nfriction_scale: {}\ncurl_gain: {}\nlateral_mps2: {}\ncovariance: [{}]\nthrows: {}\n",
      ice.friction_scale, ice.curl_gain, ice.lateral_mps2, fmt::join(ice.covariance, ", "), ice.throws);
}

void save_ice(const std::string& path, const servo::IceEstimate& ice) { replace_text(path, ice_text(ice)); }

}  // namespace hogline
