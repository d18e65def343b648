#include "app/workspace/Bench.h"

#include <QDataStream>
#include <QIODevice>
#include <QSplitter>

namespace faintline {

Bench::Bench(Document &document, const FrameKind &kind, QWidget *parent)
    : QWidget(parent), m_document(document), m_kind(kind)
{
    whenInUse(&document, &Document::analysisChanged, &Bench::showAnalysis);
    whenInUse(&document, &Document::provisionalChanged, &Bench::showStatistic);
    whenInUse(&document, &Document::shownThresholdChanged, &Bench::showThreshold);
    whenInUse(&document, &Document::shownEventsChanged, &Bench::showEvents);
}

bool Bench::isInUse() const
{
    return &m_document.frameKind() == &m_kind;
}

QByteArray Bench::saveSplitters() const
{
    QByteArray state;
    QDataStream stream(&state, QIODevice::WriteOnly);
    for (const QSplitter *splitter : splitters())
        stream << splitter->saveState();
    return state;
}

void Bench::restoreSplitters(const QByteArray &state)
{
    QDataStream stream(state);
    for (QSplitter *splitter : splitters()) {
        QByteArray own;
        stream >> own;
        const Qt::Orientation orientation = splitter->orientation(); // follows the pictures'
        splitter->restoreState(own);
        splitter->setOrientation(orientation);
    }
}

} // namespace faintline
