#pragma once

#include <QWidget>

#include <array>
#include <optional>

class QLabel;

namespace faintline {

/// One line of figures about the cell under the pointer, each in a fixed position.
class ReadOut : public QWidget
{
    Q_OBJECT

public:
    /// Unknown values are shown as a dash.
    struct Reading {
        std::optional<double> seconds; ///< from the first sample
        std::optional<double> hz;
        std::optional<double> levelDb; ///< over the noise's mean
        std::optional<double> statisticNats;
        std::optional<double> slopeHzPerSecond; ///< of the best path ending here
        std::optional<double> ageSeconds{};     ///< of that path, since its last reset
    };

    explicit ReadOut(QWidget *parent = nullptr);

    /// Unit of the statistic, by default "nat".
    void setStatisticUnit(const QString &unit);

    /// Name of the frequency, by default "Frequency".
    void setFrequencyName(const QString &name);

    /// UTC of the first sample; without it only relative time is shown.
    void setStartUnixSeconds(std::optional<double> unixSeconds);
    /// Radio frequency of 0 Hz; 0: unknown, only offsets are shown.
    void setCentreHz(double hz);
    /// Sets the resolution, which determines the number of digits: neighbouring cells must differ; and whether times are
    /// given as h:min:s, as on the axes of a long recording.
    void setResolution(double frameSeconds, double binHz, double lengthSeconds = 0.0);
    void setReading(const Reading &reading);
    void clear() { setReading({}); }

    /// The line as text, for copying.
    QString text() const;

protected:
    void contextMenuEvent(QContextMenuEvent *event) override;
    void resizeEvent(QResizeEvent *event) override;

private:
    struct Item {
        QWidget *box = nullptr;
        QLabel *name = nullptr;
        QLabel *value = nullptr;
        QString whole; ///< name
        QString brief; ///< name in a narrow line
        bool isKnown = true;
    };
    Item addItem(const QString &name, const QString &brief, const QString &widest);
    std::array<const Item *, 8> items() const;
    void fit();
    int widthOf(const Item &item, const QString &name) const;

    Item m_time, m_utc, m_frequency, m_radio, m_level, m_statistic, m_slope, m_age;
    std::optional<double> m_startUnixSeconds;
    double m_centreHz = 0.0;
    double m_frameSeconds = 0.01;
    double m_binHz = 0.1;
    bool m_isClock = false;
    Reading m_reading;
    QString m_statisticUnit = QStringLiteral("nat");
};

} // namespace faintline
