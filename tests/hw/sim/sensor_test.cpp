// The sensor's noise and response, by their statistics.
#include "hw/sim/sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hogline::hw::sim {
namespace {

constexpr int width = 1000;
constexpr int rows = 200;

struct Statistics {
  double mean = 0.0;
  double sigma = 0.0;
};

// Of the light that the bytes stand for, green only.
Statistics of(const Sensor& sensor, double light, double gamma) {
  const std::vector<float> row(width, static_cast<float>(light));
  std::vector<std::int32_t> scratch;
  std::vector<std::uint8_t> bgr(3 * width);
  double sum = 0.0;
  double squares = 0.0;
  for (int y = 0; y < rows; ++y) {
    sensor.expose(row.data(), row.data(), row.data(), 3, y, bgr.data(), scratch);
    for (int x = 0; x < width; ++x) {
      const double v = std::pow(bgr[static_cast<std::size_t>(3 * x + 1)] / 255.0, gamma);
      sum += v;
      squares += v * v;
    }
  }
  const double n = width * rows;
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * sum / n))};
}

TEST(Sensor, MeanIsTheLightAndSpreadIsShotAndReadNoise) {
  for (const double gamma : {1.0, 2.2}) {
    SensorModel model;
    model.gamma = gamma;
    model.full_scale_electrons = 4000.0;
    model.read_noise_electrons = 10.0;
    const Sensor sensor(model, 9, width);
    for (const double light : {0.05, 0.2, 0.5, 0.8}) {
      SCOPED_TRACE(testing::Message() << "gamma " << gamma << ", light " << light);
      const Statistics s = of(sensor, light, gamma);
      const double expected = std::sqrt(light / 4000.0 + std::pow(10.0 / 4000.0, 2));
      EXPECT_NEAR(s.mean, light, 0.003);
      EXPECT_NEAR(s.sigma / expected, 1.0, 0.08);
    }
  }
}

TEST(Sensor, PebbleAddsASpreadInProportionToTheLight) {
  SensorModel model;
  model.full_scale_electrons = 1e6;
  model.read_noise_electrons = 1.0;
  model.pebble_contrast = 0.03;
  EXPECT_NEAR(of(Sensor(model, 9, width), 0.9, 1.0).sigma, 0.9 * 0.03, 0.004);
}

TEST(Sensor, WithoutNoiseEveryByteIsTheRoundedResponse) {
  SensorModel model;
  model.gamma = 2.2;
  model.noisy = false;
  const Sensor sensor(model, 1, width);
  for (const double light : {0.0, 0.01, 0.1, 0.4, 0.9, 1.0, 5.0}) {
    const Statistics s = of(sensor, light, 1.0);
    EXPECT_LE(std::abs(255.0 * s.mean - sensor.byte_of(light)), 1.0) << light;
    EXPECT_NEAR(s.sigma, 0.0, 1e-5);
  }
}

}  // namespace
}  // namespace hogline::hw::sim
