// hogline itself, as one of the methods.
#pragma once

#include <memory>

#include "tests/bench/method.hpp"
#include "vision/camera_setup.hpp"

namespace hogline::bench {

/// NearView::acquire on every frame, with no memory of the one before.
std::unique_ptr<Method> make_near_acquire(const vision::CameraSetup& setup);

/// NearSequence: acquires by itself, then tracks. Without the gyro, which the others do not have.
std::unique_ptr<Method> make_near_track(const vision::CameraSetup& setup);

/// LowView::acquire on every frame, with no memory of the one before.
std::unique_ptr<Method> make_low_acquire(const vision::CameraSetup& setup);

/// LowSequence: acquires by itself, then tracks; without the wheels.
std::unique_ptr<Method> make_low_track(const vision::CameraSetup& setup);

}  // namespace hogline::bench
