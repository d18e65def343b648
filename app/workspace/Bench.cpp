#include "app/workspace/Bench.h"

#include <QDataStream>
#include <QIODevice>
#include <QSplitter>

namespace faintline {

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
        splitter->restoreState(own);
    }
}

} // namespace faintline
