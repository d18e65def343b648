#pragma once

#include "widgets/plot/ColourMap.h"

#include <QObject>

namespace faintline {

/// What several pictures show alike: colours, layers, the lines at the cursor, the projection of maps, and whether the
/// mouse measures boxes. Gestures and commands change it; every picture that was given it follows.
class PictureDisplay : public QObject
{
    Q_OBJECT

public:
    enum Layer {
        EventLayer = 1,
        TrackLayer = 2,
        TruthLayer = 4,
        ThresholdLayer = 8, ///< cells above the threshold are outlined
        GridLayer = 16,
        CursorLayer = 32,
        InhibitionLayer = 64,   ///< of pings
        ConventionalLayer = 128 ///< tracks of the conventional detector, of pings
    };
    Q_DECLARE_FLAGS(Layers, Layer)

    using QObject::QObject;

    const ColourMap &colourMap() const { return *m_colourMap; }
    bool shows(Layer layer) const { return m_layers.testFlag(layer); }
    bool isMeasuring() const { return m_isMeasuring; }
    bool hasHarmonics() const { return m_hasHarmonics; }
    double sidebandSpacing() const { return m_sidebandHz; }
    bool isPolar() const { return m_isPolar; }

    void setColourMap(const QString &name);
    void cycleColourMap() { setColourMap(ColourMap::next(m_colourMap->name())); }
    void setLayer(Layer layer, bool isOn);
    void setMeasuring(bool isOn);
    void setHarmonics(bool isOn);       ///< lines at the multiples of the cursor's frequency
    void setSidebandSpacing(double hz); ///< lines beside the cursor's frequency; 0: none
    void setPolar(bool isOn);           ///< maps of pings are seen from above

signals:
    void coloursChanged();
    void layersChanged();
    void measuringChanged();
    void linesChanged(); ///< harmonics or sidebands
    void projectionChanged();

private:
    const ColourMap *m_colourMap = &ColourMap::named(ColourMap::defaultName());
    Layers m_layers = Layers(EventLayer | TrackLayer | TruthLayer | ThresholdLayer | CursorLayer | InhibitionLayer);
    bool m_isMeasuring = false;
    bool m_hasHarmonics = false;
    double m_sidebandHz = 0.0;
    bool m_isPolar = false;
};

} // namespace faintline
