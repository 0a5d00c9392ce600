#include "engine/animation/stretch_need.h"

#include <algorithm>
#include <cmath>

#include "engine/base/exact_math.h"

namespace fjord {
namespace {

double Magnitude(double x) { return x < 0 ? -x : x; }

Vec3 Middle(const Vec3& low, const Vec3& high) { return (low + high) * .5; }
double HalfWay(const Vec3& low, const Vec3& high) { return .5 * Length(high - low); }

// Least and largest size along the axes, over all frames of a stretch.
struct ScaleBounds {
  double least_low = 0;   // the least of any axis at any time
  double least_high = 0;  // the least axis is never larger
  double largest_high = 0;
  double largest_step = 0;     // of an axis, from the middle
  double largest_inverse = 0;  // the same of 1 / size

  explicit ScaleBounds(const ShotBounds& bounds) {
    for (int i = 0; i < 3; ++i) {
      const double low = bounds.low.scale[i], high = bounds.high.scale[i];
      const double a = std::min(Magnitude(low), Magnitude(high));
      const double least = low <= 0 && high >= 0 ? 0 : a;
      const double largest = std::max(Magnitude(low), Magnitude(high));
      least_low = i == 0 ? least : std::min(least_low, least);
      least_high = i == 0 ? largest : std::min(least_high, largest);
      largest_high = std::max(largest_high, largest);
      largest_step = std::max(largest_step, .5 * (high - low));
      if (least > 0) {
        largest_inverse = std::max(largest_inverse, 1 / least - 2 / (least + largest));
      }
    }
  }
};

double DistanceBetween(const Vec3& low, const Vec3& high, const Vec3& other_low,
                       const Vec3& other_high) {
  Vec3 apart(0);
  for (int i = 0; i < 3; ++i) {
    apart[i] = std::max({0.0, other_low[i] - high[i], low[i] - other_high[i]});
  }
  return Length(apart);
}

}  // namespace

void Show(const ShotNumbers& numbers, int object_index, v1::Scene* scene) {
  const auto put = [](const Vec3& from, v1::Vec3* to) {
    to->set_x(from.x);
    to->set_y(from.y);
    to->set_z(from.z);
  };
  v1::Camera* camera = scene->mutable_camera();
  put(numbers.eye, camera->mutable_eye());
  put(numbers.look_at, camera->mutable_look_at());
  put(numbers.up, camera->mutable_up());
  camera->set_fov(numbers.fov);
  camera->set_view_height(numbers.view_height);
  camera->set_near(numbers.near);
  v1::Object* object = scene->mutable_objects(object_index);
  put(numbers.translate, object->mutable_transform()->mutable_translate());
  put(numbers.rotate, object->mutable_transform()->mutable_rotate());
  put(numbers.scale, object->mutable_transform()->mutable_scale());
  if (numbers.epsilon > 0) object->mutable_fractal()->set_epsilon(numbers.epsilon);
  if (numbers.pixels > 0) object->mutable_fractal()->set_pixels(numbers.pixels);
  if (numbers.viewing > 0) object->mutable_fractal()->set_viewing(numbers.viewing);
}

FinenessNeed NeedBetween(const ShotBounds& bounds, double ratio, const Box& rest, int object,
                         v1::Scene* scratch) {
  const uint32_t height = scratch->output().height();
  const ShotNumbers &low = bounds.low, &high = bounds.high;
  FinenessNeed need;
  const ScaleBounds scale(bounds);
  if (scale.largest_high <= 0) return need;
  need.any = true;
  ShotNumbers middle = low;
  middle.eye = Middle(low.eye, high.eye);
  middle.translate = Middle(low.translate, high.translate);
  middle.rotate = Middle(low.rotate, high.rotate);
  middle.scale = Middle(low.scale, high.scale);
  Show(middle, object, scratch);
  const ObjectTransform transform(scratch->objects(object).transform());
  const double eye_moves = HalfWay(low.eye, high.eye);
  const double shifts = HalfWay(low.translate, high.translate);
  const Vec3 turned = (high.rotate - low.rotate) * (.5 * exact::kPi / 180);
  const double turns = turned.x + turned.y + turned.z;

  CameraState camera(scratch->camera());
  camera.fov = low.fov;
  const double focal = camera.Focal(height);
  if (high.epsilon > 0) {
    need.epsilon = low.epsilon;
  } else if (high.viewing > 0) {
    const double distance = DistanceBetween(low.eye, high.eye, low.look_at, high.look_at);
    need.epsilon = .01 * distance / high.viewing;
  } else if (camera.orthographic) {
    need.epsilon = low.pixels * low.view_height / height;
  } else {
    Vec3 far(0);  // the farthest corner of the box from the object's origin
    for (int i = 0; i < 3; ++i) far[i] = std::max(Magnitude(rest.low[i]), Magnitude(rest.high[i]));
    const double farthest = Length(far);
    // every corner of the box moves by at most this from where it is at the middle
    const double corners =
        shifts + (turns * transform.largest_scale() + scale.largest_step) * farthest;
    const double distance =
        DistanceTo(WorldBox(rest, transform), middle.eye) - eye_moves - std::sqrt(3.) * corners;
    need.epsilon = low.pixels * std::max(low.near, distance * (1 - 1e-9)) / focal;
  }
  need.epsilon = need.epsilon / scale.largest_high * (1 - 1e-9);
  if (low.pixels <= 0 || camera.orthographic || scale.least_low <= 0) return need;

  // With p = S^-1 R^T (eye - translate): how far p can be from where it is at the middle.
  const double away = Length(middle.eye - middle.translate);
  need.eye.center = transform.ToObject(middle.eye);
  need.eye.radius =
      (eye_moves + shifts + turns * away) / scale.least_low + scale.largest_inverse * away;
  need.eye.radius = need.eye.radius * (1 + 1e-9) + Length(need.eye.center) * 1e-12;
  need.pixels = low.pixels;
  need.near = low.near / scale.least_high;
  const double skew = ratio > 0 ? ratio * (1 + 1e-9) : scale.largest_high / scale.least_low;
  need.focal = focal * skew;
  return need;
}

}  // namespace fjord
