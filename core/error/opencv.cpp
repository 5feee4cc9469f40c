extern "C" {
#include "core/error/opencv.h"
}

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

static cv::Mat smooth(const cv::Mat &image) {
    const int size = 11;
    cv::Mat result;
    cv::GaussianBlur(image, result, cv::Size(size, size), 1.5, 1.5, cv::BORDER_REFLECT_101);
    return result(cv::Rect(size / 2, size / 2, image.cols - size + 1, image.rows - size + 1));
}

double ang_opencv_ssim(const float *a, const float *b, int width, int height) {
    if (width < 11 || height < 11) return std::nan("");
    try {
        cv::Mat x, y;
        cv::Mat(height, width, CV_32F, const_cast<float *>(a)).convertTo(x, CV_64F);
        cv::Mat(height, width, CV_32F, const_cast<float *>(b)).convertTo(y, CV_64F);
        const double c1 = (0.01 * 255) * (0.01 * 255), c2 = (0.03 * 255) * (0.03 * 255);
        cv::Mat mx = smooth(x), my = smooth(y);
        cv::Mat mxx = mx.mul(mx), myy = my.mul(my), mxy = mx.mul(my);
        cv::Mat vx = smooth(x.mul(x)) - mxx, vy = smooth(y.mul(y)) - myy, vxy = smooth(x.mul(y)) - mxy;
        cv::Mat above = (2 * mxy + c1).mul(2 * vxy + c2);
        cv::Mat below = (mxx + myy + c1).mul(vx + vy + c2);
        cv::Mat ratio;
        cv::divide(above, below, ratio);
        return cv::mean(ratio)[0];
    } catch (const std::exception &) {
        return std::nan("");
    }
}

bool ang_opencv_heat(const float *values, int width, int height, unsigned char *rgb) {
    try {
        cv::Mat grey, colours, out(height, width, CV_8UC3, rgb);
        cv::Mat source(height, width, CV_32F, const_cast<float *>(values));
        source.convertTo(grey, CV_8U, 255);
        cv::applyColorMap(grey, colours, cv::COLORMAP_INFERNO);
        cv::cvtColor(colours, out, cv::COLOR_BGR2RGB);
        out.setTo(cv::Scalar(0, 0, 0), source <= 0);
        return true;
    } catch (const std::exception &) {
        return false;
    }
}
