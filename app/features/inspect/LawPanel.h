#pragma once

#include "app/document/Document.h"

#include <QWidget>

#include <vector>

class QLabel;
class QVBoxLayout;

namespace faintline {

class LawPlot;
class VisibilityWatcher;

/// The draggable laws of the model's rate changes, one for each in the settings, with an interpretation below.
class LawPanel : public QWidget
{
    Q_OBJECT

public:
    explicit LawPanel(const Document &document, QWidget *parent = nullptr);

    LawPlot *plot(int number) const { return m_laws[std::size_t(number)].plot; }

signals:
    /// A law was dragged: requests this value for the setting of that name.
    void lawRequested(const QString &field, const std::vector<double> &law);

private:
    /// A law of the settings, and the number of the model's axes that use it.
    struct Law {
        QString field; ///< empty: fixed
        QString title;
        std::vector<double> values;
        int mostChange = 0;
        int axes = 1;
        LawPlot *plot = nullptr;
    };

    std::vector<Law> lawsOf(const Analysis &analysis) const;
    void show();
    void sayWhatItMeans();
    QString driftWords(const Analysis &analysis) const;
    QString snrWords(const Analysis &analysis) const;

    const Document &m_document;
    std::vector<Law> m_laws;
    QVBoxLayout *m_plots;
    QLabel *m_sentence;
    VisibilityWatcher *m_sight;
    bool m_isSaid = false; ///< whether the interpretation of the current laws is shown
};

} // namespace faintline
