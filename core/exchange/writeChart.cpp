#include "exchange/writeChart.h"

#include "base/Field.h"
#include "exchange/csvText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>

namespace faintline {

namespace {

    constexpr double chartWidth = 720.0;
    constexpr double chartHeight = 480.0;
    constexpr double lowerHeight = 280.0; ///< of charts below another
    constexpr double left = 72.0;
    constexpr double right = 16.0;
    constexpr double top = 40.0;
    constexpr double bottom = 56.0;
    constexpr int ticksWanted = 6;

    /// Okabe and Ito's palette, which colour-blind readers can distinguish.
    constexpr std::array<std::string_view, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000"};

    /// Pixels rounded to a hundredth, which is invisible.
    std::string pixels(double value)
    {
        return formatNumber(std::round(value * 100.0) / 100.0);
    }

    /// One axis: values ↔ pixels, and the positions of its ticks.
    struct Scale {
        double low = std::numeric_limits<double>::infinity();
        double high = -std::numeric_limits<double>::infinity();
        bool isLogarithmic = false;
        double from = 0.0; ///< pixel of `low`
        double to = 1.0;
        double step = 1.0; ///< from tick to tick, linear

        void include(double value)
        {
            if (!std::isfinite(value) || (isLogarithmic && value <= 0.0))
                return;
            low = std::min(low, value);
            high = std::max(high, value);
        }

        /// Extends the range to whole ticks.
        void settle()
        {
            if (!(low <= high)) {
                low = isLogarithmic ? 0.1 : 0.0;
                high = 1.0;
            }
            if (isLogarithmic) {
                low = std::pow(10.0, std::floor(std::log10(low)));
                high = std::pow(10.0, std::ceil(std::log10(high)));
                if (low == high)
                    high *= 10.0;
                return;
            }
            if (low == high)
                high += 1.0;
            // From the original range: the extended one might give another step, and its top might lie off the canvas.
            step = tickStep();
            low = std::floor(low / step + 1e-9) * step;
            high = std::ceil(high / step - 1e-9) * step;
        }

        double tickStep() const
        {
            const double rough = (high - low) / ticksWanted;
            const double power = std::pow(10.0, std::floor(std::log10(rough)));
            for (const double factor : {1.0, 2.0, 5.0})
                if (factor * power >= rough * (1.0 - 1e-9))
                    return factor * power;
            return 10.0 * power;
        }

        std::vector<double> ticks() const
        {
            std::vector<double> result;
            if (isLogarithmic) {
                const int decades = int(std::lround(std::log10(high / low)));
                const int stride = std::max(1, decades / ticksWanted);
                for (int i = 0; i <= decades; i += stride)
                    result.push_back(std::pow(10.0, std::round(std::log10(low)) + i));
                return result;
            }
            const int count = int(std::lround((high - low) / step));
            for (int i = 0; i <= count; ++i)
                result.push_back(std::round(low / step + i) * step);
            return result;
        }

        double at(double value) const
        {
            const double share = isLogarithmic ? std::log(std::max(value, low * 1e-3) / low) / std::log(high / low)
                                               : (value - low) / (high - low);
            return from + share * (to - from);
        }
    };

    std::string line(double x1, double y1, double x2, double y2, std::string_view style)
    {
        return "<path d=\"M" + pixels(x1) + " " + pixels(y1) + "L" + pixels(x2) + " " + pixels(y2) + "\" "
               + std::string(style) + "/>\n";
    }

    std::string text(double x, double y, std::string_view anchor, std::string_view words, std::string_view more = "")
    {
        return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" text-anchor=\"" + std::string(anchor) + "\""
               + std::string(more) + ">" + xmlText(words) + "</text>\n";
    }

    std::string tickText(double value)
    {
        // Ten digits hide the rounding of multiples of the step.
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.10g", value);
        return formatNumber(parseNumber(digits).value_or(value));
    }

    std::string drawAxes(const Chart &chart, const Scale &x, const Scale &y)
    {
        std::string svg;
        for (const double value : x.ticks()) {
            svg += line(x.at(value), y.from, x.at(value), y.to, "stroke=\"#dddddd\"");
            svg += text(x.at(value), y.from + 18.0, "middle", tickText(value));
        }
        for (const double value : y.ticks()) {
            svg += line(x.from, y.at(value), x.to, y.at(value), "stroke=\"#dddddd\"");
            svg += text(x.from - 8.0, y.at(value) + 4.0, "end", tickText(value));
        }
        svg += "<rect x=\"" + pixels(x.from) + "\" y=\"" + pixels(y.to) + "\" width=\"" + pixels(x.to - x.from)
               + "\" height=\"" + pixels(y.from - y.to) + "\" fill=\"none\" stroke=\"#444444\"/>\n";
        svg += text(0.5 * (x.from + x.to), y.from + bottom - 16.0, "middle", chart.xLabel);
        const double middle = 0.5 * (y.from + y.to);
        svg += text(18.0, middle, "middle", chart.yLabel, " transform=\"rotate(-90 18 " + pixels(middle) + ")\"");
        svg += text(0.5 * (x.from + x.to), y.to + 24.0 - top, "middle", chart.title, " font-weight=\"bold\"");
        return svg;
    }

    std::string drawCurve(const Curve &curve, const std::string &colour, const Scale &x, const Scale &y)
    {
        std::string path;
        std::string marks;
        for (const Curve::Point &point : curve.points) {
            const std::string px = pixels(x.at(point.x));
            const std::string py = pixels(y.at(point.y));
            path += (path.empty() ? "M" : "L") + px + " " + py;
            if (point.interval.low < point.interval.high)
                marks += line(x.at(point.x), y.at(point.interval.low), x.at(point.x), y.at(point.interval.high),
                              "stroke=\"" + colour + "\"");
            if (curve.kind != Curve::Kind::Theory)
                marks += "<circle cx=\"" + px + "\" cy=\"" + py + "\" r=\"3\" stroke=\"" + colour + "\" fill=\""
                         + (curve.kind == Curve::Kind::Paper ? "white" : colour) + "\"/>\n";
            if (!point.label.empty())
                marks += text(x.at(point.x) + 7.0, y.at(point.y) + 12.0, "start", point.label);
        }
        std::string svg;
        if (curve.kind != Curve::Kind::Paper && curve.points.size() > 1)
            svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + colour + "\" stroke-width=\"1.5\""
                   + (curve.kind == Curve::Kind::Theory ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
        return svg + marks;
    }

    std::string drawLegend(const Chart &chart, const Scale &x, const Scale &y)
    {
        std::string svg;
        double row = y.to + 18.0;
        for (std::size_t i = 0; i < chart.curves.size(); ++i, row += 18.0) {
            const std::string colour(colours[i % colours.size()]);
            const Curve::Kind kind = chart.curves[i].kind;
            const double from = x.to + 12.0;
            if (kind != Curve::Kind::Paper)
                svg += line(from, row, from + 22.0, row,
                            "stroke=\"" + colour + "\" stroke-width=\"1.5\""
                                + (kind == Curve::Kind::Theory ? " stroke-dasharray=\"6 4\"" : ""));
            if (kind != Curve::Kind::Theory)
                svg += "<circle cx=\"" + pixels(from + 11.0) + "\" cy=\"" + pixels(row) + "\" r=\"3\" stroke=\""
                       + colour + "\" fill=\"" + (kind == Curve::Kind::Paper ? "white" : colour) + "\"/>\n";
            svg += text(from + 28.0, row + 4.0, "start", chart.curves[i].name);
        }
        return svg;
    }

    /// Width in pixels of the curves' names to the right of the canvas.
    double legendWidth(std::span<const Chart> charts)
    {
        constexpr double pixelsPerLetter = 7.0;
        std::size_t longestName = 0;
        for (const Chart &chart : charts)
            for (const Curve &curve : chart.curves)
                longestName = std::max(longestName, curve.name.size());
        return 48.0 + pixelsPerLetter * double(longestName);
    }

    /// Draws one chart with its canvas between two heights; `number` makes the canvas's name unique.
    std::string drawChart(const Chart &chart, double canvasTop, double canvasBottom, std::size_t number)
    {
        Scale x;
        Scale y;
        x.from = left;
        x.to = chartWidth - right;
        y.from = canvasBottom;
        y.to = canvasTop;
        x.isLogarithmic = chart.isLogarithmicX;
        y.isLogarithmic = chart.isLogarithmicY;
        for (const Curve &curve : chart.curves)
            for (const Curve::Point &point : curve.points) {
                x.include(point.x);
                y.include(point.y);
            }
        x.settle();
        y.settle();
        const std::string canvas = number == 0 ? "canvas" : "canvas" + std::to_string(number);
        std::string svg = "<defs><clipPath id=\"" + canvas + "\"><rect x=\"" + pixels(x.from - 4.0) + "\" y=\""
                          + pixels(y.to - 4.0) + "\" width=\"" + pixels(x.to - x.from + 8.0) + "\" height=\""
                          + pixels(y.from - y.to + 8.0) + "\"/></clipPath></defs>\n";
        svg += drawAxes(chart, x, y);
        svg += "<g clip-path=\"url(#" + canvas + ")\">\n";
        for (std::size_t i = 0; i < chart.curves.size(); ++i)
            svg += drawCurve(chart.curves[i], std::string(colours[i % colours.size()]), x, y);
        return svg + "</g>\n" + drawLegend(chart, x, y);
    }

} // namespace

std::string chartSvg(const Chart &chart)
{
    return chartsSvg({&chart, 1});
}

std::string chartsSvg(std::span<const Chart> charts)
{
    const double lower = double(charts.size() - 1) * lowerHeight;
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + pixels(chartWidth + legendWidth(charts))
                      + "\" height=\"" + pixels(chartHeight + lower)
                      + "\" font-family=\"Inter, sans-serif\" font-size=\"12\" fill=\"#222222\">\n<rect width=\"100%\" "
                        "height=\"100%\" fill=\"white\"/>\n";
    double end = chartHeight;
    for (std::size_t i = 0; i < charts.size(); ++i, end += lowerHeight)
        svg += drawChart(charts[i], i == 0 ? top : end - lowerHeight + top / 2.0, end - bottom, i);
    return svg + "</svg>\n";
}

std::string chartCsv(const Chart &chart)
{
    constexpr std::array<std::string_view, 3> kinds{"measured", "theory", "paper"};
    std::string csv = "curve,kind,x,y,low,high\n";
    for (const Curve &curve : chart.curves)
        for (const Curve::Point &point : curve.points) {
            const bool hasInterval = point.interval.low < point.interval.high;
            csv += csvText(curve.name) + "," + std::string(kinds[std::size_t(curve.kind)]) + "," + formatNumber(point.x)
                   + "," + formatNumber(point.y) + "," + (hasInterval ? formatNumber(point.interval.low) : "") + ","
                   + (hasInterval ? formatNumber(point.interval.high) : "") + "\n";
        }
    return csv;
}

} // namespace faintline
