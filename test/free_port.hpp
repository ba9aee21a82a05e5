#pragma once

#include <QRandomGenerator>
#include <QString>
#include <QTcpServer>

namespace pilothouse::gui {

/// A port for a master that is started later, perhaps anew: below those that the system gives to
/// every connection of whatever runs beside, which would take it meanwhile.
inline QString freePort() {
  for (;;) {
    const int port = QRandomGenerator::global()->bounded(12000, 32000);
    QTcpServer server;
    if (server.listen(QHostAddress::LocalHost, static_cast<quint16>(port))) {
      return QString::number(port);
    }
  }
}

}  // namespace pilothouse::gui
